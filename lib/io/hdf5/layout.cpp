#include "esi/io/hdf5/layout.hpp"

#include <fmt/format.h>

#include <array>

#include "esi/core/error.hpp"

namespace esi {
namespace {

/// How many of a file's datasets a message names.
constexpr std::size_t kMostListed = 20;

/// Most specific first.
constexpr std::array kLayouts = {&kDsecLayout,  &kMonashLayout,     &kM3edLayout,
                                 &kMvsecLayout, &kMetavisionLayout, &kRootLayout};

[[noreturn]] void refuse_unknown(const Hdf5File& file) {
  std::vector<std::string> known;
  known.reserve(kLayouts.size());
  for (const Hdf5Layout* const layout : kLayouts)
    known.push_back(fmt::format("{} ({})", layout->datasets, layout->name));
  std::vector<std::string> found = file.dataset_paths(kMostListed + 1);
  if (found.empty()) found.emplace_back("none");
  if (found.size() > kMostListed) found.back() = "...";
  throw Error(fmt::format("{}: no known layout of events; datasets found: {}; known layouts: {}", file.name(),
                          fmt::join(found, ", "), fmt::join(known, ", ")));
}

}  // namespace

const Hdf5Layout& find_hdf5_layout(const Hdf5File& file) {
  for (const Hdf5Layout* const layout : kLayouts) {
    if (layout->recognises(file)) return *layout;
  }
  refuse_unknown(file);
}

}  // namespace esi
