#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "api/json/version.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"

namespace plenum::server {

int RunCommandLine(int argc, const char* const* argv) {
  int status = kAnswered;
  CLI::App app("Chooses the parts of a pneumatic supply for soft robots from a catalogue.",
               "plenum");
  app.set_version_flag("--version", std::string(api::Version()));
  app.require_subcommand(1);
  try {
    AddDesignCommand(app, status);
    AddVerifyCommand(app, status);
    AddEvaluateCommand(app, status);
    AddSimulateCommand(app, status);
    AddMapCommand(app, status);
    AddDiagnoseCommand(app, status);
    AddCatalogCommand(app, status);
    AddServeCommand(app, status);
    AddJobsCommand(app, status);
    AddTokenCommand(app, status);
    app.parse(argc, argv);
    return status;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAnswered : kBadInput;
  } catch (const BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plenum: fault: %s\n", error.what());
    return kFault;
  }
}

}  // namespace plenum::server
