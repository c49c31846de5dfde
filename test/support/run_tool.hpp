#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace esi::test {

struct ToolResult {
  int exit_code = 0;  ///< 128 + signal where one ended it
  std::string out;
  std::string err;
  long peak_memory_kib = 0;  ///< of the largest process
};

/// The built tool of that name.
std::filesystem::path tool(const std::string& name);

/// The path or text as one word of a shell command line.
std::string quoted(const std::string& text);

/// Runs a shell command line; standard input is empty.
ToolResult run_shell(const std::string& command);

/// Runs a built tool with arguments, each passed as it is.
ToolResult run_tool(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace esi::test
