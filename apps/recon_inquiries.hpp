#pragma once

#include <string>

#include "recon_arguments.hpp"

namespace esi::cli {

/// The text of --list-methods: name, one line, source, defaults.
std::string methods_text();

/// The text of --list-formats.
std::string formats_text();

/// The text of --print-config.
std::string config_text(const ReconConfig& config);

/// Prints what each recording holds. Returns the worst exit code.
int print_info(const ReconArguments& arguments);

}  // namespace esi::cli
