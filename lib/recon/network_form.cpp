#include "esi/recon/network_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>

#include "esi/core/error.hpp"

namespace esi {
namespace {

constexpr int kMaxChannels = 4096;
constexpr int kMaxScale = 256;
constexpr int kMaxSide_px = 1 << 17;

std::string described(const std::vector<OnnxValue>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const OnnxValue& value : values) {
    texts.push_back(fmt::format("{} ({})", value.name, fmt::join(value.shape, " x ")));
  }
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, ", "));
}

std::optional<int> number_in(std::string_view text, int max) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < 1 || value > max) return std::nullopt;
  return value;
}

const OnnxValue* find(const std::vector<OnnxValue>& values, std::string_view name) {
  const auto is_named = [&](const OnnxValue& value) { return value.name == name; };
  const auto found = std::find_if(values.begin(), values.end(), is_named);
  return found == values.end() ? nullptr : &*found;
}

/// The second of four axes.
int channels_of(const OnnxValue& value) {
  const auto channels = value.shape.size() == 4 ? number_in(value.shape[1], kMaxChannels) : std::nullopt;
  if (channels) return *channels;
  throw Error(fmt::format("its {} has the shape ({}), where 1 x channels x height x width is needed",
                          value.name, fmt::join(value.shape, " x ")));
}

/// How much smaller an axis is than the same of the voxel grid: "height/8" beside "height", or 34 beside 272.
std::optional<int> scale_of(const std::string& axis, const std::string& whole) {
  if (axis == whole) return 1;
  if (axis.starts_with(whole + "/")) return number_in(axis.substr(whole.size() + 1), kMaxScale);
  const auto part_px = number_in(axis, kMaxSide_px);
  const auto whole_px = number_in(whole, kMaxSide_px);
  if (!part_px || !whole_px || *whole_px % *part_px != 0) return std::nullopt;
  return number_in(std::to_string(*whole_px / *part_px), kMaxScale);
}

NetworkForm::State state_of(const OnnxValue& input, const OnnxValue& voxel, const OnnxHeader& header) {
  static constexpr std::string_view kIn = "_in";
  if (!input.name.ends_with(kIn)) {
    throw Error(fmt::format("its inputs are {}: there may be 'voxel' and recurrent states NAME_in",
                            described(header.inputs)));
  }
  const std::string output = input.name.substr(0, input.name.size() - kIn.size()) + "_out";
  const OnnxValue* const next = find(header.outputs, output);
  if (next == nullptr) throw Error(fmt::format("its input {} has no output {}", input.name, output));
  const int channels = channels_of(input);
  if (channels_of(*next) != channels) {
    throw Error(fmt::format("its state {} has {} channels as input and {} as output", input.name, channels,
                            channels_of(*next)));
  }
  const auto down = scale_of(input.shape[2], voxel.shape[2]);
  const auto across = scale_of(input.shape[3], voxel.shape[3]);
  if (down && down == across) return {input.name, output, channels, *down};
  throw Error(
      fmt::format("its state {} has the size {} x {}, which is no whole part of the voxel grid's {} x {}",
                  input.name, input.shape[2], input.shape[3], voxel.shape[2], voxel.shape[3]));
}

}  // namespace

NetworkForm NetworkForm::of(const OnnxHeader& header) {
  const OnnxValue* const voxel = find(header.inputs, "voxel");
  const OnnxValue* const image = find(header.outputs, "image");
  if (voxel == nullptr || image == nullptr) {
    throw Error(fmt::format("its inputs are {} and its outputs {}, where 'voxel' and 'image' are needed",
                            described(header.inputs), described(header.outputs)));
  }
  NetworkForm form;
  form.bins = channels_of(*voxel);
  if (channels_of(*image) != 1) {
    throw Error(fmt::format("its image has {} channels, not 1", channels_of(*image)));
  }
  form.height_px = number_in(voxel->shape[2], kMaxSide_px).value_or(0);
  form.width_px = number_in(voxel->shape[3], kMaxSide_px).value_or(0);
  for (const OnnxValue& input : header.inputs) {
    if (&input != voxel) form.states.push_back(state_of(input, *voxel, header));
  }
  return form;
}

int NetworkForm::size_multiple_px() const {
  int multiple = 1;
  for (const State& state : states) multiple = std::lcm(multiple, state.scale);
  return multiple;
}

}  // namespace esi
