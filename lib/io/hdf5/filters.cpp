#include "esi/io/hdf5/filters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"

namespace esi {
namespace {

struct Plugin {
  H5Z_filter_t id;
  std::string_view name;
  std::string_view advice;
};

constexpr std::array kPlugins = {
    Plugin{kBloscFilter, "Blosc", "install the package hdf5-filter-plugin-blosc-serial"},
    Plugin{0x8ECF, "Prophesee ECF",
           "no Debian package has it; build the plugin hdf5_ecf and name its folder in HDF5_PLUGIN_PATH, or "
           "write "
           "the file again without ECF, such as with metavision_file_to_csv, whose csv is read as text"},
};
constexpr Plugin kOther = {
    0, "not known here",
    "install its plugin and name the plugin's folder in HDF5_PLUGIN_PATH, or write the "
    "file again with gzip"};

const Plugin& plugin_of(H5Z_filter_t id) {
  const auto* const found =
      std::find_if(kPlugins.begin(), kPlugins.end(), [id](const Plugin& plugin) { return plugin.id == id; });
  return found == kPlugins.end() ? kOther : *found;
}

bool can_decode(H5Z_filter_t id) {
  unsigned flags = 0;
  return H5Zfilter_avail(id) > 0 && H5Zget_filter_info(id, &flags) >= 0 &&
         (flags & H5Z_FILTER_CONFIG_DECODE_ENABLED) != 0;
}

}  // namespace

std::vector<Hdf5Filter> filters_of(hid_t creation_properties) {
  std::vector<Hdf5Filter> filters;
  const int count = H5Pget_nfilters(creation_properties);
  for (int i = 0; i < count; ++i) {
    Hdf5Filter filter;
    unsigned flags = 0;
    std::size_t parameters = 1;
    filter.id = H5Pget_filter2(creation_properties, static_cast<unsigned>(i), &flags, &parameters,
                               &filter.parameter, 0, nullptr, nullptr);
    filters.push_back(filter);
  }
  return filters;
}

void require_filters(std::span<const Hdf5Filter> filters, const std::string& where) {
  for (const Hdf5Filter& filter : filters) {
    if (can_decode(filter.id)) continue;
    const Plugin& plugin = plugin_of(filter.id);
    throw Error(fmt::format("{} is compressed with HDF5 filter {} ({}), which is not installed: {}", where,
                            filter.id, plugin.name, plugin.advice));
  }
  const auto compressors = std::count_if(filters.begin(), filters.end(), [](const Hdf5Filter& filter) {
    return filter.id != H5Z_FILTER_SHUFFLE && filter.id != H5Z_FILTER_FLETCHER32;
  });
  if (compressors > 1) throw Error(where + " is compressed twice; write the file again with one filter");
}

}  // namespace esi
