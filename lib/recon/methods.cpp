#include "esi/recon/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "esi/core/error.hpp"
#include "esi/recon/accumulator.hpp"
#include "esi/recon/complementary.hpp"
#include "esi/recon/edi.hpp"
#include "esi/recon/esi.hpp"
#include "esi/recon/esi_adaptive.hpp"
#include "esi/recon/flow/esi_flow.hpp"
#include "esi/recon/network.hpp"

namespace esi {
namespace {

/// Joins a method's Options (with `declare`) to its Reconstructor, made from (Options, SensorSize) or, where
/// it needs files, (Options, SensorSize, FileReader).
template <class Options, class Made>
class Config final : public MethodConfig {
 public:
  OptionTable& options() override { return table_; }

 private:
  std::unique_ptr<Reconstructor> make(SensorSize size,
                                      [[maybe_unused]] const FileReader& read_file) const override {
    if constexpr (std::is_constructible_v<Made, const Options&, SensorSize, const FileReader&>) {
      return std::make_unique<Made>(values_, size, read_file);
    } else {
      return std::make_unique<Made>(values_, size);
    }
  }

  Options values_;
  OptionTable table_ = table_of(values_);
};

template <class Options, class Made>
std::unique_ptr<MethodConfig> configure() {
  return std::make_unique<Config<Options, Made>>();
}

constexpr std::array kMethods{
    Method{"esi", "event-based single integration: decay, add, clamp", "Dong et al. 2025, arXiv 2508.02238",
           FrameUse::none, 8, configure<EsiOptions, Esi>},
    Method{"esi-adaptive", "ESI with polarity balance, background filter and smoothing",
           "ours; docs/methods.md", FrameUse::none, 48, configure<EsiAdaptiveOptions, EsiAdaptive>},
    Method{"esi-flow", "the image whose motion explains the events, solved for in every window",
           "ours; docs/esi_flow.md", FrameUse::none, 160, configure<EsiFlowOptions, EsiFlow>},
    Method{"accumulator", "leaky accumulator, the camera viewer's own",
           "iniVation dv-processing, Accumulator", FrameUse::none, 16,
           configure<AccumulatorOptions, Accumulator>},
    Method{"highpass", "high-pass filter: the complementary filter on events alone",
           "Scheerlinck et al. 2018, ACCV", FrameUse::none, 24, configure<HighPassOptions, HighPass>},
    Method{"complementary", "complementary filter of events and intensity frames",
           "Scheerlinck et al. 2018, ACCV", FrameUse::optional, 40,
           configure<ComplementaryOptions, Complementary>},
    Method{"edi", "event-based double integral: the latest intensity frame, made sharp",
           "Pan et al. 2019, CVPR; Lin et al. 2023", FrameUse::required, 80, configure<EdiOptions, Edi>},
    Method{"edi-propagated", "the same, carried on by events between intensity frames",
           "Pan et al. 2019, CVPR; Lin et al. 2023", FrameUse::required, 80,
           configure<EdiOptions, EdiPropagated>},
    Method{"network",
           "a recurrent network over voxel grids: E2VID, FireNet, FireNet+ (bring your own weights)",
           "Rebecq et al. 2019, arXiv 1906.07165; Scheerlinck et al. 2020, WACV", FrameUse::none, 4000,
           configure<NetworkOptions, Network>},
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method& method_named(std::string_view name) {
  const auto is_named = [name](const Method& method) { return method.name == name; };
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), is_named);
  if (found != kMethods.end()) return *found;
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const Method& method : kMethods) names.emplace_back(method.name);
  throw usage_error(
      fmt::format("method '{}' is not known; did you mean '{}'?", name, nearest_name(name, names)));
}

}  // namespace esi
