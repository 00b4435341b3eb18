#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <type_traits>

#include "api/json/version.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
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

}  // namespace

int RunCommandLine(int argc, const char* const* argv) {
  int status = kAnswered;
  CLI::App app("Chooses the parts of a pneumatic supply for soft robots from a catalogue.",
               "plenum");
  app.set_version_flag("--version", std::string(api::Version()));
  app.require_subcommand(1);
  try {
    for (const Command& command :
         {DesignCommand(), VerifyCommand(), EvaluateCommand(), SimulateCommand(), MapCommand(),
          DiagnoseCommand(), ProtocolCommand(), CatalogCommand(), ServeCommand(), JobsCommand(),
          TokenCommand()})
      Add(app, command, status);
    app.parse(argc, argv);
    return status;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAnswered : kBadInput;
  } catch (const BadInput& error) {
    Tell(error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    Tell(std::string("plenum: fault: ") + error.what());
    return kFault;
  }
}

}  // namespace plenum::server
