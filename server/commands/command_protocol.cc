#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/words.h"
#include "api/protocol/protocol_document.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"
#include "server/render/text/text_protocol.h"

namespace plenum::server {
namespace {

struct ProtocolOptions {
  std::string part, write_template;
  std::string catalog = catalog::DefaultCatalog();
  double noise_kpa = api::TestSensor().noise_kpa;
  double resolution_kpa = api::TestSensor().resolution_kpa;
  double sampling_hz = api::TestSensor().sampling_hz;
  std::optional<double> bottle_l, bottle_uncertainty;
  bool json = false;
};

catalog::Part PartOf(const ProtocolOptions& options) {
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  if (auto part = store.Get(options.part)) return *std::move(part);
  std::vector<std::string> ids;
  for (const catalog::Part& part : store.List()) ids.push_back(part.id);
  const std::string nearest = api::Nearest(options.part, ids);
  Refuse({{"PART", "no part " + api::Quoted(options.part) + " in the catalogue" +
                       (nearest.empty() ? "" : "; nearest id: " + nearest)}});
}

// The template of the first test that is recorded.
void WriteTemplate(const std::string& path, const api::Json& protocol) {
  for (const api::Json& test : protocol.at("tests")) {
    if (!test.at("recording").is_object()) continue;
    std::ofstream file(path, std::ios::binary);
    file << Dump(test.at("recording").at("template"), 2) << '\n';
    if (!file.flush()) Refuse({{"--template", "cannot write " + path}});
    return;
  }
  Refuse({{"--template", "no test of this part is recorded"}});
}

int Protocol(const ProtocolOptions& options) {
  const api::Json protocol =
      api::RenderProtocol(PartOf(options), {.noise_kpa = options.noise_kpa,
                                            .resolution_kpa = options.resolution_kpa,
                                            .sampling_hz = options.sampling_hz,
                                            .bottle_l = options.bottle_l,
                                            .bottle_uncertainty = options.bottle_uncertainty});
  if (!options.write_template.empty()) WriteTemplate(options.write_template, protocol);
  Print(options.json ? Dump(protocol) + "\n" : ProtocolText(protocol));
  return kAnswered;
}

Within Of(const api::Range& range) { return {range.low, range.high}; }

}  // namespace

Command ProtocolCommand() {
  auto options = std::make_shared<ProtocolOptions>();
  return {"protocol",
          "How to measure a part, and how precise that will be",
          "plenum protocol generic-lp-small-200kpa --template recording.json",
          {Argument("PART", "The part's id", &options->part),
           {"--sensor-noise-kpa",
            "Noise of a reading, one standard deviation",
            &options->noise_kpa,
            {.value_name = "KPA", .shows_default = true, .allowed = Of(api::SensorKpaRange())}},
           {"--sensor-resolution-kpa",
            "Step of the readings",
            &options->resolution_kpa,
            {.value_name = "KPA", .shows_default = true, .allowed = Of(api::SensorKpaRange())}},
           {"--sampling-hz",
            "Readings a second, at most",
            &options->sampling_hz,
            {.value_name = "HZ", .shows_default = true, .allowed = Of(api::SamplingRange())}},
           {"--bottle-l",
            "Volume of the bottle; a fitting one without it",
            &options->bottle_l,
            {.value_name = "L", .allowed = Of(api::BottleRange())}},
           {"--bottle-uncertainty",
            "Of its volume, relative: 0.002 of one weighed full of water; assumed without it",
            &options->bottle_uncertainty,
            {.value_name = "SHARE", .allowed = Of(api::BottleUncertaintyRange())}},
           {"--template",
            "Write the file that the recording needs",
            &options->write_template,
            {.value_name = "FILE"}},
           JsonFlag(options->json),
           CatalogOption(options->catalog)},
          [options] { return Protocol(*options); }};
}

}  // namespace plenum::server
