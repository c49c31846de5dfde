#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

struct apriltag_family;

namespace esi {

/// What has to be known of a family before it is used.
struct TagFamilyInfo {
  std::string name;
  int id_count = 0;  ///< ids are 0 to id_count - 1
  int bits = 0;

  /// Memory of the AprilTag library's table of codes with up to so many wrong bits.
  double decode_table_bytes(int corrected_bits) const;
};

/// All that the AprilTag library has.
std::vector<std::string> tag_family_names();
/// The same for help texts: "tag16h5, tag25h9, ...".
std::string tag_family_list();

/// Throws a usage Error that lists the families, and names the nearest, for other names.
TagFamilyInfo tag_family_info(const std::string& name);

/// Throws a usage Error with the range of ids where one isn't of the family.
void require_tag_ids(const std::string& family, std::span<const int> ids);

using TagFamily = std::unique_ptr<apriltag_family, void (*)(apriltag_family*)>;
/// The library's own object, for one detector. Throws as tag_family_info().
TagFamily make_tag_family(const std::string& name);

}  // namespace esi
