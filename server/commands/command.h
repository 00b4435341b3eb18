// A command of `plenum` as a value: a table of options, what it runs, or the commands below it.
// command_line.cc, which alone knows CLI11, makes the parser of them.
#ifndef PLENUM_SERVER_COMMANDS_COMMAND_H_
#define PLENUM_SERVER_COMMANDS_COMMAND_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plenum::server {

// Values that an option takes; others are refused with a message that names them.
struct Within {
  double least, most;
};
struct Positive {};
using OneOf = std::vector<std::string>;

struct OptionRules {
  std::optional<std::string> value_name = {};  // in the help; the value's type without one
  bool required = false;
  bool shows_default = false;  // in the help, what stands in the target at first
  std::variant<std::monostate, Within, Positive, OneOf> allowed = {};
  std::string excludes = {};  // name of an option before this one
};

struct Option {
  // Where the value goes; a flag where that is a bool. It must live as long as the command.
  using Target =
      std::variant<bool*, int*, long long*, double*, std::string*, std::vector<std::string>*,
                   std::optional<int>*, std::optional<std::int64_t>*, std::optional<double>*>;

  std::string name;  // "--top"; "FILE", by its place; "!--no-log", a flag that says no
  std::string help;
  Target target;
  OptionRules rules = {};
};

struct Command {
  std::string name, help;
  std::string example;  // a line that can be typed from the checkout
  std::vector<Option> options;
  std::function<int()> run;  // gives the exit status
  // One of them must be named where there is no `run`, which is for none named; they take the
  // options of this command, too.
  std::vector<Command> commands = {};
};

// What several commands take.
inline Option CatalogOption(std::string& path) {
  return {"--catalog",
          "The catalogue, a file or postgresql://USER@HOST/DATABASE; without it PLENUM_CATALOG, "
          "catalog.db in this folder, or your own",
          &path,
          {.value_name = "DB"}};
}
inline Option JsonFlag(bool& json) {
  return {"--json", "One JSON document on standard output", &json};
}
// A value that must be given, by its place.
inline Option Argument(const char* name, const char* help, Option::Target target) {
  return {name, help, target, {.value_name = "", .required = true}};
}

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_COMMAND_H_
