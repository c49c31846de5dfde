#pragma once

#include <string>

namespace CLI {
class App;
}

namespace esi::cli {

/// Adds the hidden flags --generate-man and --generate-completion, which print to stdout and exit.
void add_doc_flags(CLI::App& app);

/// A man page (section 1, groff) of all options.
std::string man_page(const CLI::App& app);

/// A completion script for bash.
std::string bash_completion(const CLI::App& app);

}  // namespace esi::cli
