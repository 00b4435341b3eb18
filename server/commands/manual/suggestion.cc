#include "server/commands/manual/suggestion.h"

#include <algorithm>
#include <span>

#include "api/json/words.h"

namespace plenum::server {
namespace {

// What may be typed for an option: "--no-log" of "!--no-log".
std::string Typed(const Option& option) { return option.name.substr(option.name.front() == '!'); }

bool IsFlag(const Option& option) { return std::holds_alternative<bool*>(option.target); }

std::string Unknown(const std::string& path, const char* kind, const std::string& word,
                    const std::vector<std::string>& known) {
  return path + " has no " + kind + " " + api::Quoted(word) +
         "; nearest: " + api::Nearest(word, known) + ". " + path + " --help names all.";
}

// The command line as far as it was read.
struct Place {
  std::string path = "plenum";
  std::span<const Command> commands;  // one of which may come next
  std::vector<Option> options;        // that may come next
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const Command& command : commands) names.push_back(command.name);
    return names;
  }
  std::vector<std::string> option_names() const {
    std::vector<std::string> names = {"--help"};
    if (path == "plenum") names.push_back("--version");
    for (const Option& option : options)
      if (Typed(option).starts_with("--")) names.push_back(Typed(option));
    return names;
  }
};

}  // namespace

std::string UnknownWord(const std::vector<Command>& commands,
                        const std::vector<std::string>& words) {
  Place place{.commands = commands, .options = {}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") break;
    if (word.starts_with("--")) {
      const std::string name = word.substr(0, word.find('='));
      const auto known = place.option_names();
      if (std::find(known.begin(), known.end(), name) == known.end())
        return Unknown(place.path, "option", name, known);
      const auto option = std::find_if(place.options.begin(), place.options.end(),
                                       [&](const Option& one) { return Typed(one) == name; });
      const bool has_value = option != place.options.end() && !IsFlag(*option);
      if (has_value && name == word) ++i;  // the next word is the value
      continue;
    }
    if (word.starts_with('-') || place.commands.empty()) continue;
    const auto command = std::find_if(place.commands.begin(), place.commands.end(),
                                      [&](const Command& one) { return one.name == word; });
    if (command == place.commands.end()) return Unknown(place.path, "command", word, place.names());
    place.path += " " + word;
    place.options.insert(place.options.end(), command->options.begin(), command->options.end());
    place.commands = command->commands;
  }
  return "";
}

}  // namespace plenum::server
