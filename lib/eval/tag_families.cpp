#include "esi/eval/tag_families.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "esi/core/error.hpp"
#include "esi/core/options.hpp"

namespace esi {
namespace {

struct Entry {
  const char* name;
  int id_count, bits;  // making a family only to look at it would copy up to 65535 codes
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<Entry, 9> kFamilies{{
    {"tag16h5", 30, 16, tag16h5_create, tag16h5_destroy},
    {"tag25h9", 35, 25, tag25h9_create, tag25h9_destroy},
    {"tag36h10", 2320, 36, tag36h10_create, tag36h10_destroy},
    {"tag36h11", 587, 36, tag36h11_create, tag36h11_destroy},
    {"tagCircle21h7", 38, 21, tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagCircle49h12", 65535, 49, tagCircle49h12_create, tagCircle49h12_destroy},
    {"tagCustom48h12", 42211, 48, tagCustom48h12_create, tagCustom48h12_destroy},
    {"tagStandard41h12", 2115, 41, tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", 48714, 52, tagStandard52h13_create, tagStandard52h13_destroy},
}};

const Entry& find_family(const std::string& name) {
  for (const Entry& family : kFamilies) {
    if (family.name == name) return family;
  }
  const std::vector<std::string> names = tag_family_names();
  throw usage_error(fmt::format("there is no tag family \"{}\"; the nearest is {}, known are {}", name,
                                nearest_name(name, names), tag_family_list()));
}

}  // namespace

// The library reserves n * (1 + b + b (b - 1) + b (b - 1) (b - 2)) entries, cut at the corrected bits, three
// times over, of 16 bytes each.
double TagFamilyInfo::decode_table_bytes(int corrected_bits) const {
  double words = 1.0, sum = 1.0;
  for (int bit = 0; bit < corrected_bits; ++bit) sum += words *= bits - bit;
  return sum * id_count * 3.0 * 16.0;
}

std::vector<std::string> tag_family_names() {
  std::vector<std::string> names;
  for (const Entry& family : kFamilies) names.emplace_back(family.name);
  return names;
}

std::string tag_family_list() { return fmt::format("{}", fmt::join(tag_family_names(), ", ")); }

TagFamilyInfo tag_family_info(const std::string& name) {
  const Entry& family = find_family(name);
  return {family.name, family.id_count, family.bits};
}

void require_tag_ids(const std::string& family, std::span<const int> ids) {
  const int id_count = tag_family_info(family).id_count;
  const auto is_foreign = [&](int id) { return id < 0 || id >= id_count; };
  const auto wrong = std::find_if(ids.begin(), ids.end(), is_foreign);
  if (wrong == ids.end()) return;
  throw usage_error(
      fmt::format("there is no tag {} in {}, whose ids are 0 to {}", *wrong, family, id_count - 1));
}

TagFamily make_tag_family(const std::string& name) {
  const Entry& entry = find_family(name);
  apriltag_family_t* const family = entry.create();
  if (family == nullptr) throw Error("not enough memory for the tag family " + name);
  return {family, entry.destroy};
}

}  // namespace esi
