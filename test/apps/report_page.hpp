#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <pugixml.hpp>
#include <string>

#include "support/temp_folder.hpp"

namespace esi::test {

/// The page is well formed, without scripts, and asks for nothing from elsewhere.
inline void check_page(const std::filesystem::path& file) {
  const std::string text = content_of(file);
  pugi::xml_document page;
  const auto result = page.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  INFO(result.description() << " at " << result.offset);
  REQUIRE(result);
  CHECK(page.select_nodes("//script | //iframe | //object").empty());
  for (const auto& node : page.select_nodes("//@src | //@href")) {
    CHECK(std::string(node.attribute().value()).starts_with("data:"));
  }
  CHECK_FALSE(page.select_nodes("//table").empty());
  CHECK_FALSE(page.select_nodes("//*[local-name()='svg']").empty());
  CHECK(text.find("@import") == std::string::npos);
  CHECK(text.find("url(") == std::string::npos);
}

}  // namespace esi::test
