#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "esi/io/hdf5/file.hpp"

namespace esi {

/// The numbers of an attribute of `object` (a group's or dataset's path), as float64: of a scalar or an
/// array. Nothing where there is no such attribute, or one of another type or with more than `limit` values.
std::optional<std::vector<double>> numeric_attribute(const Hdf5File& file, const std::string& object,
                                                     const std::string& name, std::size_t limit);

/// The text of an attribute, of fixed or variable length. Nothing where there is no such attribute, or one of
/// another type, or of more than 1000 characters.
std::optional<std::string> text_attribute(const Hdf5File& file, const std::string& object,
                                          const std::string& name);

}  // namespace esi
