#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "api/json/version.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/manual/completion.h"
#include "server/commands/manual/man_page.h"
#include "server/commands/manual/suggestion.h"
#include "server/commands/output.h"

namespace plenum::server {
namespace {

// In the type of the target, which the help names.
void Allow(CLI::Option& added, const Option& option) {
  if (const auto* within = std::get_if<Within>(&option.rules.allowed)) {
    if (std::holds_alternative<int*>(option.target))
      added.check(CLI::Range(static_cast<int>(within->least), static_cast<int>(within->most)));
    else
      added.check(CLI::Range(within->least, within->most));
  }
  if (std::holds_alternative<Positive>(option.rules.allowed)) added.check(CLI::PositiveNumber);
  if (const auto* names = std::get_if<OneOf>(&option.rules.allowed))
    added.check(CLI::IsMember(*names));
}

void Add(CLI::App& app, const Option& option) {
  CLI::Option* added = std::visit(
      [&](auto* target) {
        if constexpr (std::is_same_v<decltype(target), bool*>)
          return app.add_flag(option.name, *target, option.help);
        else
          return app.add_option(option.name, *target, option.help);
      },
      option.target);
  const OptionRules& rules = option.rules;
  if (rules.value_name) added->type_name(*rules.value_name);
  if (rules.required) added->required();
  if (rules.shows_default) added->capture_default_str();
  if (!rules.excludes.empty()) added->excludes(rules.excludes);
  Allow(*added, option);
}

void Add(CLI::App& app, const Command& command, int& status) {
  CLI::App* added = app.add_subcommand(command.name, command.help);
  added->footer("Example: " + command.example);
  for (const Option& option : command.options) Add(*added, option);
  for (const Command& below : command.commands) Add(*added, below, status);
  if (!command.options.empty())  // which may follow a command below this one
    for (CLI::App* below : added->get_subcommands({})) below->fallthrough();
  if (!command.commands.empty()) added->require_subcommand(command.run ? 0 : 1, 1);
  if (command.run)
    added->callback([&status, added, run = command.run] {
      if (added->get_subcommands().empty()) status = run();
    });
}

constexpr char kFirstWords[] =
    R"(plenum chooses the parts of a pneumatic supply for soft robots, and proves its choice.

  plenum init my.json       asks for your requirements and writes them into a file
  plenum design my.json     the best designs for it, with the proof
  plenum serve              the same on a page in the browser
  plenum --help             all commands; plenum COMMAND --help: one of them
)";

std::vector<std::string> Words(int argc, const char* const* argv) {
  return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

// What is asked for beside the commands. Packages are made with the last two.
std::optional<int> RunWithoutCommand(const std::vector<std::string>& words,
                                     const std::vector<Command>& commands) {
  if (words.empty()) {
    std::fputs(kFirstWords, stderr);
    return kBadInput;
  }
  if (words.front() == "--man") {
    std::fputs(ManPage(commands).c_str(), stdout);
    return kAnswered;
  }
  if (words.front() == "--bash-completion") {
    std::fputs(BashCompletion(commands).c_str(), stdout);
    return kAnswered;
  }
  return std::nullopt;
}

int RunCommand(int argc, const char* const* argv) {
  int status = kAnswered;
  const std::vector<Command> commands = AllCommands();
  const std::vector<std::string> words = Words(argc, argv);
  if (const auto done = RunWithoutCommand(words, commands)) return *done;
  CLI::App app("Chooses the parts of a pneumatic supply for soft robots from a catalogue.",
               "plenum");
  app.set_version_flag("--version", std::string(api::Version()));
  app.footer("Example: plenum design examples/exosuit.json");
  app.require_subcommand(1);
  for (const Command& command : commands) Add(app, command, status);
  try {
    app.parse(argc, argv);
    return status;
  } catch (const CLI::Success& asked) {  // for help or the version
    app.exit(asked);
    return kAnswered;
  } catch (const CLI::ParseError& error) {
    if (const std::string unknown = UnknownWord(commands, words); !unknown.empty())
      throw BadInput(unknown);
    app.exit(error);
    return kBadInput;
  }
}

}  // namespace

std::vector<Command> AllCommands() {
  return {InitCommand(),     DesignCommand(),   SweepCommand(),    VerifyCommand(),
          EvaluateCommand(), ExportCommand(),   SimulateCommand(), MapCommand(),
          DiagnoseCommand(), ProtocolCommand(), CatalogCommand(),  ServeCommand(),
          WorkerCommand(),   JobsCommand(),     TokenCommand()};
}

int RunCommandLine(int argc, const char* const* argv) {
  try {
    return RunCommand(argc, argv);
  } catch (const BadInput& error) {
    Tell(error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    Tell(std::string("plenum: fault: ") + error.what());
    return kFault;
  }
}

}  // namespace plenum::server
