#pragma once

#include <hdf5.h>

#include <span>
#include <string>
#include <vector>

namespace esi {

inline constexpr H5Z_filter_t kLzfFilter = 32000;
inline constexpr H5Z_filter_t kBloscFilter = 32001;

/// The filters that a dataset's chunks went through when they were written.
struct Hdf5Filter {
  H5Z_filter_t id = 0;
  unsigned parameter = 0;  ///< the first of the filter's own
};
std::vector<Hdf5Filter> filters_of(hid_t creation_properties);

/// Throws an Error for filters that HDF5 cannot undo here, with the number and the package to install, and
/// for data that is compressed twice, which may take any amount of memory to undo. `where` begins the
/// message: "FILE: dataset /x".
void require_filters(std::span<const Hdf5Filter> filters, const std::string& where);

}  // namespace esi
