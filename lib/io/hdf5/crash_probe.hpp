#pragma once

#include <functional>
#include <optional>
#include <string>

namespace esi {

struct CrashProbeLimits {
  unsigned cpu_s = 5;    ///< more counts as an endless loop
  unsigned wall_s = 60;  ///< a slow disk is no crash: then the attempt is given up and counts as passed
};

/// libhdf5 1.10 crashes on some damaged files, or never returns. A child process makes the attempt first, and
/// dies in our place. Returns how: "signal 11 (Segmentation fault)"; nothing where it came back, with an
/// Error or without, and where no child could be started, or could not allocate (see the .cpp).
///
/// The child has this thread only, holding Hdf5Lock: beyond libhdf5 the attempt must use nothing that other
/// threads may have locked, such as OpenCV or the standard streams.
std::optional<std::string> crash_of(const std::function<void()>& attempt,
                                    const CrashProbeLimits& limits = {});

}  // namespace esi
