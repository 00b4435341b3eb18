// Options that several commands share.
#ifndef PLENUM_SERVER_COMMANDS_COMMAND_OPTIONS_H_
#define PLENUM_SERVER_COMMANDS_COMMAND_OPTIONS_H_

#include <CLI/CLI.hpp>
#include <string>

namespace plenum::server {

inline void AddCatalogOption(CLI::App& command, std::string& path) {
  command.add_option("--catalog", path, "The catalogue")->type_name("DB")->capture_default_str();
}

inline void AddJsonFlag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "One JSON document on standard output");
}

inline void AddFile(CLI::App& command, std::string& file, const char* what) {
  command.add_option("FILE", file, what)->required()->type_name("");
}

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_COMMAND_OPTIONS_H_
