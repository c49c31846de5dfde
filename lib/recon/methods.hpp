#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "esi/core/event.hpp"
#include "esi/core/options.hpp"
#include "esi/recon/reconstructor.hpp"

namespace esi {

/// Gives the whole content of the file at a path, or throws an Error that names it. Methods that learnt from
/// data need their model's file; lib/recon opens none, so whoever creates them lends this.
using FileReader = std::function<std::string(const std::string& path)>;

/// A method with values for its options: what --set and a config change, and what makes reconstructors.
class MethodConfig {
 public:
  virtual ~MethodConfig() = default;
  virtual OptionTable& options() = 0;
  /// Throws a usage Error on values that don't go together, and what `read_file` throws for a file that an
  /// option names.
  std::unique_ptr<Reconstructor> create(SensorSize size, const FileReader& read_file = {}) const {
    return make(size, read_file);
  }

 private:
  virtual std::unique_ptr<Reconstructor> make(SensorSize size, const FileReader& read_file) const = 0;
};

/// What a method makes of the camera's own intensity frames.
enum class FrameUse {
  none,      ///< lives on events alone
  optional,  ///< better with them
  required,  ///< nothing without them
};

/// One row of the methods table.
struct Method {
  std::string_view name;     ///< as --method takes it
  std::string_view summary;  ///< one line
  std::string_view source;   ///< paper
  FrameUse frames = FrameUse::none;
  std::uint64_t state_bytes_per_pixel = 8;       ///< about, for refusing what no memory holds
  std::unique_ptr<MethodConfig> (*configure)();  ///< with the method's defaults
};

/// Every known method.
std::span<const Method> methods();

/// Throws a usage Error that names the nearest known method.
const Method& method_named(std::string_view name);

}  // namespace esi
