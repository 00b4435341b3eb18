#include "python/core/measured_parts.h"

#include "api/json/words.h"
#include "api/protocol/part_revision.h"
#include "api/protocol/protocol_document.h"
#include "api/protocol/read_by_hand.h"
#include "python/core/documents.h"
#include "python/core/part_store.h"

namespace plenum::python {
namespace {

using catalog::Access;

catalog::Part PartOf(const catalog::Store& store, const std::string& id) {
  if (auto part = store.Get(id)) return *std::move(part);
  throw Refused({{"/id", "no part has the id " + api::Quoted(id)}});
}

void CheckSpecimen(const std::string& specimen, const std::string& id) {
  if (const std::string why = api::WhyInvalidSpecimen(specimen, id); !why.empty())
    throw Refused({{"/specimen", why}});
}

// The recordings that a diagnosis names.
std::vector<api::Provenance::File> FilesOf(const api::Json& diagnosis) {
  std::vector<api::Provenance::File> files;
  for (const api::Json& file : diagnosis.at("provenance").at("files"))
    files.push_back({file.at("name").get<std::string>(), file.at("sha256").get<std::string>()});
  return files;
}

}  // namespace

std::string Protocol(const std::string& path, const std::string& id,
                     const std::multimap<std::string, std::string>& sensor) {
  const api::TestSensor known = ValueOrRefuse(api::ParseTestSensor(sensor));
  return Dump(api::RenderProtocol(PartOf(OpenCatalogue(path, Access::kRead), id), known));
}

std::string SavePart(const std::string& path, const std::string& id, const std::string& diagnosis,
                     const MeasuredBy& by) {
  CheckSpecimen(by.specimen, id);
  const api::Json answer = Parse(diagnosis);
  auto store = OpenCatalogue(path, Access::kWrite);
  PartOf(store, id);
  try {
    return Dump(api::SavePart(store, id, answer, FilesOf(answer), by.anyway, {by.who, {}, {}},
                              by.specimen));
  } catch (const api::Json::exception&) {
    throw Refused(api::Errors{{"", "is no answer of diagnose()"}});
  }
}

std::string WriteMeasured(const std::string& path, const std::string& id,
                          const std::vector<std::string>& readings, const std::string& uncertainty,
                          const std::string& note, const MeasuredBy& by) {
  CheckSpecimen(by.specimen, id);
  auto store = OpenCatalogue(path, Access::kWrite);
  const api::Json answer =
      ValueOrRefuse(api::ReadByHandAnswer(PartOf(store, id), readings, uncertainty, note));
  return Dump(api::SavePart(store, id, answer, {}, by.anyway, {by.who, {}, {}}, by.specimen));
}

}  // namespace plenum::python
