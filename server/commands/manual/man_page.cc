#include "server/commands/manual/man_page.h"

#include <fmt/format.h>

#include "api/json/version.h"

namespace plenum::server {
namespace {

constexpr char kDescription[] =
    "plenum chooses the parts of a pneumatic supply for soft robots from a catalogue, proves that "
    "no "
    "other combination of these parts is better, and says what a model lacks against measured "
    "pressures.";

// A text between commands of man: signs that mean something there are escaped.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (c == '\n')
      escaped += ' ';
    else
      escaped += c;
  }
  const bool command = escaped.starts_with('.') || escaped.starts_with('\'');
  return command ? "\\&" + escaped : escaped;
}

std::string Paragraph(const char* macro, const std::string& text) {
  return std::string(macro) + "\n" + Escaped(text) + "\n";
}

bool ByPlace(const Option& option) {
  return !option.name.starts_with('-') && !option.name.starts_with('!');
}

// "FILE", "[FILE]", "[--top N]"
std::string Usage(const Option& option) {
  if (ByPlace(option)) return option.rules.required ? option.name : "[" + option.name + "]";
  const std::string name = option.name.substr(option.name.front() == '!');
  if (std::holds_alternative<bool*>(option.target)) return "[" + name + "]";
  return "[" + name + " " + option.rules.value_name.value_or("VALUE") + "]";
}

// "ipopt, nlopt", "0 to 65535"; empty where any value will do.
std::string Allowed(const Option& option) {
  std::string text;
  if (const auto* names = std::get_if<OneOf>(&option.rules.allowed))
    for (const std::string& name : *names) text += (text.empty() ? "" : ", ") + name;
  if (const auto* within = std::get_if<Within>(&option.rules.allowed))
    text = fmt::format("{:.15g} to {:.15g}", within->least, within->most);
  if (std::holds_alternative<Positive>(option.rules.allowed)) text = "above 0";
  return text;
}

// What the target holds at first, where the help shows it.
std::string Default(const Option& option) {
  if (!option.rules.shows_default) return "";
  if (const auto* const* text = std::get_if<std::string*>(&option.target)) return **text;
  if (const auto* const* number = std::get_if<int*>(&option.target))
    return std::to_string(**number);
  if (const auto* const* number = std::get_if<double*>(&option.target))
    return fmt::format("{:g}", **number);
  return "";
}

std::string Describe(const Option& option) {
  std::string usage = Usage(option);
  if (usage.front() == '[') usage = usage.substr(1, usage.size() - 2);
  std::string help = option.help;
  const std::string allowed = Allowed(option), value = Default(option);
  if (!allowed.empty()) help += " (" + allowed + ")";
  if (!value.empty()) help += "; default " + value;
  return ".TP\n\\fB" + Escaped(usage) + "\\fR\n" + Escaped(help) + "\n";
}

void Describe(const Command& command, const std::string& before, std::string& page) {
  const std::string name = before + " " + command.name;
  std::string usage = name;
  for (const Option& option : command.options) usage += " " + Usage(option);
  if (!command.commands.empty()) usage += command.run ? " [COMMAND]" : " COMMAND";
  page +=
      ".SS \"" + Escaped(name) + "\"\n" + Escaped(command.help) + ".\n" + Paragraph(".PP", usage);
  for (const Option& option : command.options) page += Describe(option);
  page += ".PP\nExample:\n.PP\n.RS\n.nf\n" + Escaped(command.example) + "\n.fi\n.RE\n";
  for (const Command& below : command.commands) Describe(below, name, page);
}

}  // namespace

std::string ManPage(const std::vector<Command>& commands) {
  std::string page = ".TH PLENUM 1 \"\" \"plenum " + std::string(api::Version()) + "\"\n";
  page += ".SH NAME\nplenum \\- parts of pneumatic supplies for soft robots, with a proof\n";
  page += ".SH SYNOPSIS\n\\fBplenum\\fR COMMAND [OPTIONS]\n";
  page += ".SH DESCRIPTION\n" + Escaped(kDescription) + "\n.SH COMMANDS\n";
  for (const Command& command : commands) Describe(command, "plenum", page);
  page += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] :
       {std::pair("0", "answered; an infeasible problem is an answer"),
        std::pair("2", "bad input; each error names the field and what is allowed"),
        std::pair("3", "a fault of the program"),
        std::pair("130", "interrupted; the best so far is printed")})
    page += std::string(".TP\n") + status + "\n" + Escaped(meaning) + "\n";
  page +=
      ".SH ENVIRONMENT\n.TP\nPLENUM_CATALOG\nThe catalogue of a command without \\-\\-catalog.\n";
  page +=
      ".TP\nXDG_DATA_HOME\nThe user's catalogue is plenum/catalog.db in it (else in "
      "~/.local/share).\n";
  return page;
}

}  // namespace plenum::server
