#include "esi/recon/pixel_grid.hpp"

#include <fmt/format.h>

#include "esi/core/error.hpp"

namespace esi {

void refuse_pixels(SensorSize size, std::size_t bytes, std::string_view method) {
  throw Error(fmt::format("{}: a sensor of {} px needs {:.1f} GB of memory, more than there is", method,
                          to_string(size), static_cast<double>(bytes) * 1e-9));
}

}  // namespace esi
