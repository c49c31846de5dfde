#include "esi/eval/detector_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "esi/core/error.hpp"
#include "esi/eval/tag_families.hpp"

namespace esi {
namespace {

constexpr double kLargestTable_bytes = 512.0 * 1024 * 1024;
constexpr std::int64_t kMostCorrectedBits = 2;  // what the AprilTag library says it finds

}  // namespace

void DetectorOptions::declare(OptionTable& table) {
  table.text("family", family, "family of the tags: " + tag_family_list(),
             [](const std::string& name) { tag_family_info(name); });
  table.integer("corrected_bits", corrected_bits, {0, 3}, "",
                "wrong bits that are corrected; each one more lets in more false tags");
  table.real("min_margin", min_margin, {0.0, 255.0}, "grey levels",
             "least decision margin of a detection: how far its bits are from the threshold, on average");
  table.real("quad_decimate", quad_decimate, {1.0, 16.0}, "",
             "quads are looked for in the image shrunk by this: a whole number, or 1.5");
  table.real("quad_sigma", quad_sigma_px, {-4.0, 4.0}, "px",
             "Gaussian before quads are looked for; negative sharpens");
  table.toggle("refine_edges", refine_edges, "move a quad's edges to the strongest gradient beside them");
  table.real("decode_sharpening", decode_sharpening, {0.0, 10.0}, "",
             "sharpening of the grid of bits before it is decoded");
  table.integer("min_cluster", min_cluster_px, {1, 100000}, "px", "least pixels of an outline");
  table.integer("max_maxima", max_maxima, {4, 100}, "", "corner candidates of an outline that are tried");
  table.real("critical_angle", critical_angle_deg, {0.0, 89.0}, "deg",
             "quads are refused whose edges meet at less, or at more than 180 less this");
  table.real("max_line_fit_mse", max_line_fit_mse_px2, {0.0, 1e6}, "px^2",
             "mean squared distance of an outline from the line through it, at most");
  table.integer("min_contrast", min_contrast, {0, 255}, "grey levels",
                "least difference of white and black where a threshold is set");
  table.toggle("deglitch", deglitch, "close holes of the thresholded image, for very noisy ones");
}

void DetectorOptions::check() const {
  const TagFamilyInfo info = tag_family_info(family);
  if (quad_decimate != 1.5 && quad_decimate != std::floor(quad_decimate)) {
    throw usage_error(
        fmt::format("option quad_decimate: {} is neither 1.5 nor a whole number", quad_decimate));
  }
  if (corrected_bits > kMostCorrectedBits) {
    throw usage_error(
        fmt::format("option corrected_bits: {} are too many, for {} they would take {:.1f} GB and let false "
                    "tags in; take {} at most",
                    corrected_bits, family, info.decode_table_bytes(static_cast<int>(corrected_bits)) / 1e9,
                    kMostCorrectedBits));
  }
  const double bytes = info.decode_table_bytes(static_cast<int>(corrected_bits));
  if (bytes <= kLargestTable_bytes) return;
  throw usage_error(fmt::format(
      "option corrected_bits: correcting {} bits of {} would take {:.1f} GB of memory; take 1 at most",
      corrected_bits, family, bytes / 1e9, corrected_bits > 2 ? "take 2 at most" : "take 1 at most"));
}

}  // namespace esi
