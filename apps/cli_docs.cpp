#include "cli_docs.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "esi/core/version.hpp"

namespace esi::cli {
namespace {

// A leading dot or quote is a command to groff; a plain - would be printed as a hyphen.
std::string groff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
  }
  return !escaped.empty() && (escaped[0] == '.' || escaped[0] == '\'') ? "\\&" + escaped : escaped;
}

/// CLI11 would write the second name of a switch as "--no-strict{false}".
std::string names_of(const CLI::Option& option, bool positional) {
  if (positional) return option.get_name(true);
  std::string names;
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const std::string& name : option.get_snames()) add("-" + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  return names;
}

class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    return names_of(*option, positional);
  }
};

bool is_shown(const CLI::Option* option) { return !option->get_group().empty(); }

std::string option_entry(const CLI::Option& option) {
  std::string text = ".TP\n\\fB" + groff(names_of(option, option.get_positional())) + "\\fR";
  if (option.get_items_expected_max() > 0 && !option.get_positional())
    text += " \\fI" + groff(option.get_type_name()) + "\\fR";
  text += "\n" + groff(option.get_description());
  if (!option.get_default_str().empty()) text += " (default: " + groff(option.get_default_str()) + ")";
  return text + "\n";
}

}  // namespace

void add_doc_flags(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormatter>());
  const auto print_and_leave = [](const std::string& text) {
    fmt::print("{}", text);
    throw CLI::Success();
  };
  const auto add = [&](const std::string& name, auto text_of) {
    app.add_flag_callback(name, [&app, text_of, print_and_leave] { print_and_leave(text_of(app)); })
        ->trigger_on_parse()
        ->group("");
  };
  add("--generate-man", man_page);
  add("--generate-completion", bash_completion);
}

std::string man_page(const CLI::App& app) {
  std::string text =
      fmt::format(".TH {} 1 \"\" \"esi {}\" \"User Commands\"\n.nh\n.SH NAME\n{} \\- {}\n", app.get_name(),
                  version(), groff(app.get_name()), groff(app.get_description()));
  const bool takes_recordings = app.get_option_no_throw("RECORDING") != nullptr;
  text += fmt::format(".SH SYNOPSIS\n.B {}\n[OPTION]...{}\n.SH OPTIONS\n", groff(app.get_name()),
                      takes_recordings ? " RECORDING..." : "");
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) continue;
    text += ".SS " + groff(group) + "\n";
    for (const CLI::Option* option :
         app.get_options([&](const CLI::Option* o) { return o->get_group() == group; })) {
      text += option_entry(*option);
    }
  }
  text +=
      ".SH EXIT STATUS\n0 done; 1 it could not be done; 2 wrong usage; 3 done, but damaged input was left "
      "out; "
      "4 a required threshold was missed; 130, 143, 141 stopped by INT, TERM or a closed pipe.\n";
  return text;
}

std::string bash_completion(const CLI::App& app) {
  std::string flags;
  for (const CLI::Option* option : app.get_options(is_shown)) {
    for (const std::string& name : option->get_lnames()) flags += "--" + name + " ";
  }
  std::string function = app.get_name();
  std::replace(function.begin(), function.end(), '-', '_');
  return fmt::format(
      "_{0}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}}\n"
      "  if [[ $word == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W '{1}' -- \"$word\"))\n"
      "  else\n"
      "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _{0} {2}\n",
      function, flags, app.get_name());
}

}  // namespace esi::cli
