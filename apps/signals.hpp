#pragma once

namespace esi::cli {

/// INT and TERM ask for an orderly end (a second one ends at once). A closed pipe and a size limit become
/// errors of the write that meets them.
void install_signal_handlers();

/// The signal that asked for an end, or 0.
int stop_signal();

/// 130 or 143 for the signal that asked for an end.
int stop_exit_code();

}  // namespace esi::cli
