#include "server/commands/manual/completion.h"

#include <fmt/core.h>

namespace plenum::server {
namespace {

// Lines of the script's case statements.
struct Cases {
  std::string places;  // from one place of the command line to the next
  std::string values;  // words of an option
  std::string words;   // commands and options of a place
};

std::string Joined(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

// `place` is the path so far: " catalog list"; `inherited` are the options of commands above.
void AddCases(const std::vector<Command>& commands, const std::string& place,
              std::vector<std::string> inherited, const std::vector<Option>& options,
              Cases& cases) {
  inherited.emplace_back("--help");
  for (const Option& option : options) {
    const std::string name = option.name.substr(option.name.front() == '!');
    if (!name.starts_with("--")) continue;
    inherited.push_back(name);
    if (const auto* values = std::get_if<OneOf>(&option.rules.allowed))
      cases.values += fmt::format("    \"{} {}\") words=\"{}\" ;;\n", place, name, Joined(*values));
  }
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const Command& command : commands) {
    names.push_back(command.name);
    const std::string below = place + " " + command.name;
    cases.places += fmt::format("      \"{}\") place=\"{}\" ;;\n", below, below);
    AddCases(command.commands, below, inherited, command.options, cases);
  }
  cases.words += "    \"" + place + "\") commands=\"" + Joined(names) + "\"; options=\"" +
                 Joined(inherited) + "\" ;;\n";
}

}  // namespace

std::string BashCompletion(const std::vector<Command>& commands) {
  Cases cases;
  AddCases(commands, "", {}, {}, cases);
  return "# bash completion of plenum, printed by plenum --bash-completion\n"
         "_plenum() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local place= words= commands= options= word\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \"$place $word\" in\n" +
         cases.places +
         "    esac\n"
         "  done\n"
         "  case \"$place $before\" in\n" +
         cases.values +
         "  esac\n"
         "  case \"$place\" in\n" +
         cases.words +
         "  esac\n"
         "  [ -n \"$words\" ] || words=$commands\n"
         "  case \"$current\" in -*) words=$options ;; esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _plenum plenum\n";
}

}  // namespace plenum::server
