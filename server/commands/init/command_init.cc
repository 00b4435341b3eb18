#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/init/interview.h"
#include "server/commands/input.h"
#include "server/render/text/text_remarks.h"

namespace plenum::server {
namespace {

struct InitOptions {
  std::string file = "requirements.json";
  std::string catalog = catalog::DefaultCatalog();
  bool replace = false;
};

Opinion Judge(const api::Json& requirements, const std::vector<catalog::Part>& parts) {
  auto parsed = api::ParseRequirements(requirements, parts);
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return {std::move(*errors), ""};
  const api::Json warnings = {{"warnings", std::get<api::DesignRequest>(parsed).remarks.warnings}};
  return {{}, RemarksText(warnings)};
}

void Write(const std::string& path, const api::Json& document) {
  std::ofstream file(path, std::ios::binary);
  file << Dump(document, 2) << '\n';
  if (!file.flush()) throw BadInput(path + ": cannot be written");
}

int Init(const InitOptions& options) {
  const bool print = options.file == "-";
  if (!print && !options.replace && std::filesystem::exists(options.file))
    throw BadInput(options.file + ": is there already; name another file, or say --replace");
  const bool person = isatty(STDIN_FILENO) != 0;
  const auto parts = OpenCatalog(options.catalog, catalog::Access::kRead).List();
  Interview interview{
      .answers = std::cin,
      .say =
          [&](const std::string& text) {
            if (person) std::fputs(text.c_str(), stderr);
          },
      .person = person,
      .judge = [&](const api::Json& requirements) { return Judge(requirements, parts); }};
  interview.say(
      "An empty answer takes what stands in brackets. Units may follow a number: 15 psi.\n");
  const api::Json document = AskRequirements(interview);
  if (print) {
    std::fputs((Dump(document, 2) + "\n").c_str(), stdout);
    return kAnswered;
  }
  Write(options.file, document);
  std::printf("%s written. Now: plenum design %s\n", options.file.c_str(), options.file.c_str());
  return kAnswered;
}

}  // namespace

Command InitCommand() {
  auto options = std::make_shared<InitOptions>();
  return {"init",
          "Asks for requirements and writes them into a file",
          "plenum init my.json",
          {{"FILE",
            "The file; - is standard output",
            &options->file,
            {.value_name = "", .shows_default = true}},
           {"--replace", "Also where the file is there already", &options->replace},
           CatalogOption(options->catalog)},
          [options] { return Init(*options); }};
}

}  // namespace plenum::server
