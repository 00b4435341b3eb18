#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "api/catalogue/stores.h"
#include "api/design/verification.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/interrupt.h"
#include "server/commands/output.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

struct VerifyOptions {
  std::string file;
  std::string catalog = catalog::DefaultCatalog();
  bool json = false;
  bool brute_force = false;
  std::optional<double> time_limit_s;
  long long combinations_max = verify::kBruteForceMax;
};

// One line on the terminal, written over and over; nothing when errors go to a file.
class ShareLine {
 public:
  void Show(double share) {
    const int per_mille = static_cast<int>(1000.0 * share);
    if (!terminal_ || per_mille == shown_) return;
    shown_ = per_mille;
    std::fprintf(stderr, "\r\x1b[K%.1f %% of all combinations", 0.1 * per_mille);
    std::fflush(stderr);
  }
  ~ShareLine() {
    if (shown_ >= 0) std::fputs("\r\x1b[K", stderr);
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) != 0;
  int shown_ = -1;
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
  if (json.contains("brute_force")) {
    const auto& counts = json["brute_force"];
    text += (counts["cancelled"] ? "Stopped after " : "Enumerated ") +
            Grouped(counts["combinations"]) + " combinations:";
    const char* separator = " ";
    for (const char* kind :
         {"incompatible", "unpriced", "beyond_the_list", "infeasible", "feasible", "undecided"}) {
      text += separator + std::string(kind) + " " + Grouped(counts[kind]);
      separator = ", ";
    }
    text += "\n";
  }
  if (json["stopped"]) return text + "Not accepted: stopped before all was looked at.\n";
  return text + (json["accepted"] ? "Accepted.\n" : "Refused.\n");
}

// Interrupted, or out of time.
std::function<bool()> StopOf(std::optional<double> time_limit_s) {
  using Clock = std::chrono::steady_clock;
  return [time_limit_s, start = Clock::now()] {
    return Interrupted() ||
           (time_limit_s && Clock::now() - start > std::chrono::duration<double>(*time_limit_s));
  };
}

// A refused result gives a failing status, so that scripts see it; why is on standard error.
int Verify(const VerifyOptions& options) {
  const auto result = ReadJson(options.file, api::kResultBytesMax);
  const auto [revision, parts] =
      OpenCatalog(options.catalog, catalog::Access::kRead).ListWithHead();
  CatchInterrupts();
  std::optional<api::BruteForce> brute_force;
  ShareLine line;
  if (options.brute_force)
    brute_force =
        api::BruteForce{options.combinations_max, [&](double share) { line.Show(share); }};
  const auto json = ValueOrRefuse(
      api::VerifyAnswer(result, parts, revision, brute_force, StopOf(options.time_limit_s)));
  Print(options.json ? Dump(json) + "\n" : VerificationText(json));
  if (json["accepted"]) return kAnswered;
  if (Interrupted()) return kInterrupted;
  for (const auto& check : json["checks"])
    if (!check["ok"])
      Tell("refused: " + check["check"].get<std::string>() + ": " +
           check["detail"].get<std::string>());
  if (json["stopped"])
    std::fprintf(stderr, "not accepted: out of time after %g s, before all was looked at\n",
                 *options.time_limit_s);
  return kBadInput;
}

}  // namespace

Command VerifyCommand() {
  auto options = std::make_shared<VerifyOptions>();
  return {"verify",
          "Checks a saved answer of design from scratch",
          "plenum verify result.json",
          {Argument("FILE", "Answer of design --json; - is standard input", &options->file),
           {"--brute-force", "Look at every combination, too", &options->brute_force},
           {"--combinations-max",
            "More than these are not looked at one by one",
            &options->combinations_max,
            {.value_name = "N", .shows_default = true, .allowed = Positive{}}},
           {"--time-limit",
            "Seconds to check; what is not looked at by then is not accepted",
            &options->time_limit_s,
            {.value_name = "S", .allowed = Positive{}}},
           JsonFlag(options->json),
           CatalogOption(options->catalog)},
          [options] { return Verify(*options); }};
}

}  // namespace plenum::server
