#include "esi/io/rosbag/fields.hpp"

#include <algorithm>

namespace esi {

std::optional<RosbagFields::Field> RosbagFields::next() {
  std::uint32_t length = 0;
  if (is_damaged_ || bytes_.empty()) return std::nullopt;
  is_damaged_ = bytes_.size() < sizeof length;
  if (is_damaged_) return std::nullopt;
  std::memcpy(&length, bytes_.data(), sizeof length);
  bytes_ = bytes_.subspan(sizeof length);
  is_damaged_ = length > bytes_.size();
  if (is_damaged_) return std::nullopt;

  const auto field = bytes_.first(length);
  bytes_ = bytes_.subspan(length);
  const auto equals = std::find(field.begin(), field.end(), std::byte{'='});
  is_damaged_ = equals == field.end();
  if (is_damaged_) return std::nullopt;
  const auto name_bytes = static_cast<std::size_t>(equals - field.begin());
  return Field{{reinterpret_cast<const char*>(field.data()), name_bytes}, field.subspan(name_bytes + 1)};
}

}  // namespace esi
