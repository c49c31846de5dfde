#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "esi/report/svg.hpp"
#include "esi/report/table.hpp"

namespace esi {

/// A page that needs nothing else: styles, drawings and pictures stand within it. Texts are escaped.
class HtmlPage {
 public:
  explicit HtmlPage(std::string title);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  void table(const Table& table);
  void drawing(const Svg& svg, std::string_view caption);
  /// `png` is the file's content.
  void picture(std::span<const std::byte> png, std::string_view caption);
  /// As it was typed.
  void code(std::string_view text);

  std::string str() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace esi
