#include "esi/io/hdf5/attributes.hpp"

#include <cstring>

namespace esi {
namespace {

constexpr std::size_t kLongestText = 1000;

struct Attribute {
  Hdf5Handle object, id, type;
  std::size_t values = 0;
};

/// Under the caller's Hdf5Lock. Without values where there is no such attribute.
Attribute open(const Hdf5File& file, const std::string& object, const std::string& name) {
  Attribute attribute;
  attribute.object = file.open_object(object);
  if (!attribute.object) return attribute;
  attribute.id = Hdf5Handle(H5Aopen(attribute.object.get(), name.c_str(), H5P_DEFAULT));
  if (!attribute.id) return attribute;
  attribute.type = Hdf5Handle(H5Aget_type(attribute.id.get()));
  const Hdf5Handle space(H5Aget_space(attribute.id.get()));
  const hssize_t values = H5Sget_simple_extent_npoints(space.get());
  attribute.values = values > 0 ? static_cast<std::size_t>(values) : 0;
  return attribute;
}

std::optional<std::string> variable_text(const Attribute& attribute) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5Tget_cset(attribute.type.get()));
  char* text = nullptr;
  if (H5Aread(attribute.id.get(), type.get(), static_cast<void*>(&text)) < 0 || text == nullptr)
    return std::nullopt;
  const std::size_t length = strnlen(text, kLongestText + 1);
  std::string copy(text, length);
  H5free_memory(text);
  if (length > kLongestText) return std::nullopt;
  return copy;
}

std::optional<std::string> fixed_text(const Attribute& attribute) {
  const std::size_t size = H5Tget_size(attribute.type.get());
  if (size == 0 || size > kLongestText) return std::nullopt;
  std::string text(size, '\0');
  if (H5Aread(attribute.id.get(), attribute.type.get(), text.data()) < 0) return std::nullopt;
  text.resize(strnlen(text.data(), size));
  return text;
}

}  // namespace

std::optional<std::vector<double>> numeric_attribute(const Hdf5File& file, const std::string& object,
                                                     const std::string& name, std::size_t limit) {
  const Hdf5Lock lock;
  const Attribute attribute = open(file, object, name);
  if (attribute.values == 0 || attribute.values > limit) return std::nullopt;
  const H5T_class_t kind = H5Tget_class(attribute.type.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return std::nullopt;
  std::vector<double> values(attribute.values);
  if (H5Aread(attribute.id.get(), H5T_NATIVE_DOUBLE, values.data()) < 0) return std::nullopt;
  return values;
}

std::optional<std::string> text_attribute(const Hdf5File& file, const std::string& object,
                                          const std::string& name) {
  const Hdf5Lock lock;
  const Attribute attribute = open(file, object, name);
  if (attribute.values != 1 || H5Tget_class(attribute.type.get()) != H5T_STRING) return std::nullopt;
  const bool is_variable = H5Tis_variable_str(attribute.type.get()) > 0;
  return is_variable ? variable_text(attribute) : fixed_text(attribute);
}

}  // namespace esi
