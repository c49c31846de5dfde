#include "esi/report/html_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "esi/report/escape.hpp"

namespace esi {
namespace {

constexpr std::string_view kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1140px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0;font-variant-numeric:tabular-nums}"
    "th,td{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right}td{white-space:nowrap}"
    "th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #222}"
    "caption{text-align:left;font-weight:bold;padding:.3em 0}figure{margin:1em 0;overflow-x:auto}"
    "figcaption{color:#555}img,svg{max-width:100%;height:auto}img{image-rendering:pixelated}"
    "pre{background:#f4f4f4;padding:.7em;overflow-x:auto}";

/// RFC 4648.
std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (j < count ? std::to_integer<unsigned>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? kDigits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return text;
}

}  // namespace

HtmlPage::HtmlPage(std::string title) : title_(std::move(title)) {}

void HtmlPage::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", html_text(text)); }
void HtmlPage::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", html_text(text)); }
void HtmlPage::table(const Table& table) { body_ += to_html(table); }
void HtmlPage::code(std::string_view text) { body_ += fmt::format("<pre>{}</pre>\n", html_text(text)); }

void HtmlPage::drawing(const Svg& svg, std::string_view caption) {
  body_ += fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg.str(), html_text(caption));
}

void HtmlPage::picture(std::span<const std::byte> png, std::string_view caption) {
  body_ += fmt::format(
      "<figure>\n<img src=\"data:image/png;base64,{}\" alt=\"{}\"/>\n<figcaption>{}</figcaption>\n"
      "</figure>\n",
      base64(png), html_text(caption), html_text(caption));
}

std::string HtmlPage::str() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>{0}</title>\n"
      "<link rel=\"icon\" "
      "href=\"data:,\"/>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}</body>\n</html>\n",
      html_text(title_), kStyle, body_);
}

}  // namespace esi
