// The subcommands of `plenum`. Each adds itself to the application; its work runs as the CLI11
// callback and leaves the exit status in `status`.
//
// One file each: command_*.cc.
#ifndef PLENUM_SERVER_COMMANDS_COMMANDS_H_
#define PLENUM_SERVER_COMMANDS_COMMANDS_H_

namespace CLI {
class App;
}

namespace plenum::server {

void AddDesignCommand(CLI::App& app, int& status);
void AddVerifyCommand(CLI::App& app, int& status);
void AddEvaluateCommand(CLI::App& app, int& status);
void AddSimulateCommand(CLI::App& app, int& status);
void AddMapCommand(CLI::App& app, int& status);
void AddDiagnoseCommand(CLI::App& app, int& status);
void AddCatalogCommand(CLI::App& app, int& status);
void AddServeCommand(CLI::App& app, int& status);
void AddJobsCommand(CLI::App& app, int& status);
void AddTokenCommand(CLI::App& app, int& status);

// The whole command line; gives the exit status.
int RunCommandLine(int argc, const char* const* argv);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_COMMANDS_H_
