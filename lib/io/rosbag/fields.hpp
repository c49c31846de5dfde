#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace esi {

/// The `name=value` fields of a record's header or of a connection's data. See formats.md section 8.1.
class RosbagFields {
 public:
  struct Field {
    std::string_view name;
    std::span<const std::byte> value;

    /// The value as text.
    std::string_view text() const { return {reinterpret_cast<const char*>(value.data()), value.size()}; }
    /// The value as a little-endian number; empty where it has another size.
    template <class Number>
    std::optional<Number> number() const {
      if (value.size() != sizeof(Number)) return std::nullopt;
      Number result;
      std::memcpy(&result, value.data(), sizeof result);
      return result;
    }
  };

  explicit RosbagFields(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// Empty at the end, and from the first damage on.
  std::optional<Field> next();
  bool is_damaged() const { return is_damaged_; }

 private:
  std::span<const std::byte> bytes_;
  bool is_damaged_ = false;
};

}  // namespace esi
