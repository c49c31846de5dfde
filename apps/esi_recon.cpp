#include <fmt/format.h>

#include "cli.hpp"
#include "recon_arguments.hpp"
#include "recon_batch.hpp"
#include "recon_inquiries.hpp"
#include "signals.hpp"

namespace {

int run(int argc, char** argv) {
  using namespace esi::cli;
  ReconArguments arguments;
  int exit_code = kDone;
  if (!parse_recon_arguments(argc, argv, arguments, exit_code)) return exit_code;

  if (arguments.list_methods) return fmt::print("{}", methods_text()), kDone;
  if (arguments.list_formats) return fmt::print("{}", formats_text()), kDone;
  if (arguments.print_config) return fmt::print("{}", config_text(arguments.config)), kDone;
  if (arguments.info) return print_info(arguments);
  return run_batch(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  esi::cli::install_signal_handlers();
  return esi::cli::guarded("esi-recon", [&] { return run(argc, argv); });
}
