#include <catch2/catch.hpp>
#include <pugixml.hpp>
#include <string>

#include "esi/report/escape.hpp"
#include "esi/report/html_page.hpp"
#include "esi/report/table.hpp"

using namespace esi;
using Catch::Matchers::Contains;

namespace {

const std::string kEvil = "a,\"b\" <script>alert('x')</script> & 50 %_$#{}\\~^|*`[c]";

pugi::xml_document parsed(const std::string& page) {
  pugi::xml_document document;
  const auto result = document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype);
  INFO(result.description() << " at " << result.offset);
  REQUIRE(result);
  return document;
}

}  // namespace

TEST_CASE("csv fields are quoted where they must be, and only there") {
  CHECK(csv_field("straight") == "straight");
  CHECK(csv_field("a b_%") == "a b_%");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("the \"best\"") == "\"the \"\"best\"\"\"");
  CHECK(csv_field("two\nlines") == "\"two\nlines\"");
  CHECK(csv_field("two\rlines") == "\"two\rlines\"");
}

TEST_CASE("what means something to HTML, LaTeX or Markdown means itself") {
  CHECK(html_text("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  CHECK(html_text("a\x01\x1f\t\n\r") == "a\xEF\xBF\xBD\xEF\xBF\xBD\t\n\r");
  CHECK(tex_text("_&%$#{}") == "\\_\\&\\%\\$\\#\\{\\}");
  CHECK(tex_text("\\~^<>\"") ==
        "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}\\textless{}\\textgreater{}\\textquotedbl{}");
  CHECK(tex_text("two\nlines") == "two lines");
  CHECK(markdown_cell("a|b *c* _d_ `e` [f] <g> & #h") ==
        "a\\|b \\*c\\* \\_d\\_ \\`e\\` \\[f\\] &lt;g&gt; &amp; \\#h");
  CHECK(markdown_cell("two\r\nlines") == "two  lines");
}

TEST_CASE("a table comes out in four formats") {
  const Table table{"Rates, in %", {"method", "straight"}, {{"esi", "81.4"}, {"a|b,c", "-"}}};
  CHECK(to_csv(table) == "method,straight\nesi,81.4\n\"a|b,c\",-\n");
  CHECK(to_markdown(table) ==
        "Rates, in %\n\n| method | straight |\n|---|---:|\n| esi | 81.4 |\n| a\\|b,c | - |\n");
  CHECK(to_tex(table) ==
        "\\begin{table}\n\\centering\n\\caption{Rates, in \\%}\n\\begin{tabular}{lr}\n\\toprule\nmethod & "
        "straight "
        "\\\\\n\\midrule\nesi & 81.4 \\\\\na|b,c & - \\\\\n\\bottomrule\n\\end{tabular}\n\\end{table}\n");
  CHECK(to_html(table) ==
        "<table>\n<caption>Rates, in "
        "%</caption>\n<thead><tr><th>method</th><th>straight</th></tr>\n</thead>\n<tbody>\n"
        "<tr><td>esi</td><td>81.4</td></tr>\n<tr><td>a|b,c</td><td>-</td></tr>\n</tbody>\n</table>\n");
}

TEST_CASE("a page is well formed whatever its texts hold, and asks for nothing from elsewhere") {
  HtmlPage page(kEvil);
  page.heading(kEvil);
  page.paragraph(kEvil);
  page.code(kEvil);
  page.table({kEvil, {kEvil, "b"}, {{kEvil, kEvil}}});
  Svg svg(100, 50);
  svg.text({1, 2}, kEvil);
  svg.upright_text({1, 2}, kEvil);
  svg.rectangle({0, 0}, 10, 10, "#fff", kEvil);
  page.drawing(svg, kEvil);
  const std::string bytes = "any";
  page.picture(std::as_bytes(std::span(bytes)), kEvil);
  const auto document = parsed(page.str());
  CHECK(document.select_node("//title").node().text().get() == kEvil);
  CHECK(document.select_node("//h2").node().text().get() == kEvil);
  CHECK(document.select_node("//p").node().text().get() == kEvil);
  CHECK(document.select_node("//td").node().text().get() == kEvil);
  CHECK(document.select_node("//*[local-name()='text']").node().text().get() == kEvil);
  CHECK(document.select_nodes("//script").empty());
  CHECK(document.select_node("//img").node().attribute("alt").value() == kEvil);
  for (const auto& found : document.select_nodes("//@href | //@src")) {
    CHECK_THAT(found.attribute().value(), Catch::StartsWith("data:"));
  }
}

TEST_CASE("pictures stand in a page as base64, padded to full groups") {
  const auto encoded = [](const std::string& text) {
    HtmlPage page("t");
    page.picture(std::as_bytes(std::span(text)), "");
    const std::string source = parsed(page.str()).select_node("//img/@src").attribute().value();
    return source.substr(source.find(',') + 1);
  };
  CHECK(encoded("").empty());
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foo") == "Zm9v");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\x3f") == "//4/");
}
