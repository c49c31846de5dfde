#pragma once

#include <string_view>

namespace esi {

/// The toolkit's version, "1.2.3".
std::string_view version();

}  // namespace esi
