#include <cstdio>
#include <memory>

#include "api/verify.h"
#include "server/command_options.h"
#include "server/commands.h"
#include "server/exit_status.h"
#include "server/input.h"
#include "server/reply.h"
#include "server/text_table.h"

namespace plenum::server {
namespace {

struct VerifyOptions {
  std::string file;
  std::string catalog = "catalog.db";
  bool json = false;
};

std::string VerificationText(const api::Json& json) {
  Table table(
      {{"check", Table::Align::kLeft}, {"", Table::Align::kLeft}, {"", Table::Align::kLeft}});
  for (const auto& check : json["checks"])
    table.Add({check["check"], check["ok"] ? "ok" : "REFUSED", check["detail"]});
  std::string text = table.Text();
  for (const auto& open : json["not_rechecked"])
    text += "Not rechecked: " + Grouped(open["combinations"]) + " × " +
            open["what"].get<std::string>() + "\n";
  return text + (json["accepted"] ? "Accepted.\n" : "Refused.\n");
}

// A refused result gives a failing status, so that scripts see it; why is on standard error.
int Verify(const VerifyOptions& options) {
  const auto result = ReadJson(options.file);
  const auto [revision, parts] =
      OpenCatalog(options.catalog, catalog::Access::kRead).ListWithHead();
  const auto json = ValueOrRefuse(api::VerifyAnswer(result, parts, revision));
  std::fputs(options.json ? (Dump(json) + "\n").c_str() : VerificationText(json).c_str(), stdout);
  if (json["accepted"]) return kAnswered;
  for (const auto& check : json["checks"])
    if (!check["ok"])
      std::fprintf(stderr, "refused: %s: %s\n", check["check"].get<std::string>().c_str(),
                   check["detail"].get<std::string>().c_str());
  return kBadInput;
}

}  // namespace

void AddVerifyCommand(CLI::App& app, int& status) {
  auto options = std::make_shared<VerifyOptions>();
  auto* command = app.add_subcommand("verify", "Checks a saved answer of design from scratch");
  AddFile(*command, options->file, "Answer of design --json; - is standard input");
  AddJsonFlag(*command, options->json);
  AddCatalogOption(*command, options->catalog);
  command->callback([options, &status] { status = Verify(*options); });
}

}  // namespace plenum::server
