#include "cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <optional>
#include <thread>

#include "cli_docs.hpp"
#include "esi/core/error.hpp"

namespace esi::cli {
namespace {

constexpr int kMaxThreads = 1024;

/// What was said since hold_messages(); one process has one stderr.
std::optional<std::string> held;

/// Seconds go without saying on a command line; other units stay in the name.
std::string flag_name(const Option& option) {
  std::string name = option.name();
  if (option.unit() == "s" && name.ends_with("_s")) name.resize(name.size() - 2);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

std::string help_of(const Option& option) {
  const std::string domain = option.domain();
  if (option.is_switch()) return option.help() + (option.text() == "true" ? " (default: on)" : "");
  if (domain.empty()) return option.help();
  return fmt::format("{} [{}]", option.help(), domain);
}

// "The following argument was not expected: --fsp" becomes a question about the nearest flag.
std::string extras_text(const CLI::App& app) {
  const std::string unknown = app.remaining().empty() ? std::string() : app.remaining().front();
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string flag = unknown.substr(0, unknown.find('='));
  return fmt::format("there is no option {}; did you mean {}?", flag, nearest_name(flag, names));
}

}  // namespace

void say(const std::string& tool, const std::string& what) {
  const std::string line = fmt::format("{}: {}\n", tool, what);
  if (held) {
    *held += line;
    return;
  }
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

void hold_messages() { held = ""; }

std::string held_messages() { return held.value_or(""); }

int report(const std::string& tool, const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    say(tool, "the memory is used up; use a smaller sensor, fewer --threads or --jobs, or a larger limit");
    return kFailed;
  }
  say(tool, error.what());
  const auto* own = dynamic_cast<const Error*>(&error);
  return own != nullptr && own->kind() == Error::Kind::usage ? kUsage : kFailed;
}

int worst_of(int a, int b) {
  static constexpr int kFromMildToGrave[] = {kDone,   kDoneWithLosses, kRequirementMissed, kUsage,
                                             kFailed, kPipeClosed,     kInterrupted,       kTerminated};
  const auto gravity = [](int code) {
    return std::find(std::begin(kFromMildToGrave), std::end(kFromMildToGrave), code);
  };
  return gravity(a) > gravity(b) ? a : b;
}

int guarded(const std::string& tool, const std::function<int()>& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    return report(tool, error);
  }
}

int checked_threads(const char* flag, std::int64_t given) {
  if (given < 1 || given > kMaxThreads) {
    throw usage_error(fmt::format("{}: {} is not possible, give 1 to {}", flag, given, kMaxThreads));
  }
  return static_cast<int>(given);
}

void TableFlags::add(CLI::App& app, OptionTable table, const std::string& group) {
  for (const Option& option : table.options()) {
    Flag& flag = flags_.emplace_back(Flag{option, nullptr, option.text(), false});
    const std::string name = flag_name(option);
    if (option.is_switch()) {
      flag.flag = app.add_flag(name + ",!--no-" + name.substr(2), flag.state, help_of(option));
    } else {
      flag.flag = app.add_option(name, flag.text, help_of(option));
      const std::string value = option.text();
      if (!value.empty() && value != "none") flag.flag->default_str(value);
      flag.flag->type_name(option.unit().empty() ? "VALUE" : option.unit());
    }
    flag.flag->group(group);
  }
}

void TableFlags::apply() {
  for (Flag& flag : flags_) {
    if (flag.flag->count() == 0) continue;
    flag.option.set_text(flag.option.is_switch() ? (flag.state ? "true" : "false") : flag.text);
  }
}

RunningFlags::RunningFlags() : threads(std::max(1U, std::thread::hardware_concurrency())) {}

void RunningFlags::add(CLI::App& app) {
  app.add_option("--threads", threads, "threads; they make no difference to the result")
      ->type_name("N")
      ->group(kGroup);
  app.add_flag("--quiet", quiet, "no progress and no summary")->group(kGroup);
  app.add_flag("--print-config", print_config, "print the merged options as a config, and end")
      ->group(kGroup);
}

bool parse(CLI::App& app, int argc, const char* const* argv, int& exit_code) {
  add_doc_flags(app);
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::ExtrasError&) {
    say(app.get_name(), extras_text(app));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      exit_code = app.exit(error) == 0 ? kDone : kUsage;
      return false;
    }
    say(app.get_name(), fmt::format("{} (see {} --help)", error.what(), app.get_name()));
  }
  exit_code = kUsage;
  return false;
}

}  // namespace esi::cli
