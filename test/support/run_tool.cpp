#include "support/run_tool.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "support/temp_folder.hpp"

namespace esi::test {

std::filesystem::path tool(const std::string& name) { return std::filesystem::path(ESI_BIN_DIR) / name; }

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

ToolResult run_shell(const std::string& command) {
  const TempFolder folder;
  const auto out = folder / "out";
  const auto err = folder / "err";
  const std::string line =
      "exec </dev/null >" + quoted(out.string()) + " 2>" + quoted(err.string()) + "; " + command;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    execl("/bin/bash", "bash", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) throw std::runtime_error("cannot wait for: " + command);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, content_of(out), content_of(err), usage.ru_maxrss};
}

ToolResult run_tool(const std::string& name, const std::vector<std::string>& arguments) {
  std::string command = quoted(tool(name).string());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  return run_shell(command);
}

}  // namespace esi::test
