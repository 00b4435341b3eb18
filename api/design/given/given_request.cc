#include "api/design/given/given_request.h"

#include <chrono>
#include <utility>

#include "api/design/read/combination.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/joint_rows.h"
#include "api/design/read/stock_volume.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/power.h"
#include "api/json/remarks.h"
#include "api/json/shared_fields.h"

namespace plenum::api {

std::function<bool()> After(double seconds) {
  using Clock = std::chrono::steady_clock;
  return [start = Clock::now(), limit = std::chrono::duration<double>(seconds)] {
    return Clock::now() - start > limit;
  };
}

Parsed<GivenRequest> ReadGivenRequest(const Json& request, const std::vector<catalog::Part>& parts,
                                      const std::vector<catalog::ModelRevision>& models) {
  Errors errors;
  RemarkRecorder recorder;
  Reader reader(request, "", errors);
  reader.Schema("evaluation/1");
  const Json* requirements = reader.Raw("requirements");
  if (requirements == nullptr)
    reader.Fail("requirements", "is required: a document requirements/1");
  if (!errors.empty()) return errors;
  auto parsed = ParseRequirements(*requirements, parts, models);
  if (auto* wrong = std::get_if<Errors>(&parsed)) {
    PutUnder("/requirements", *wrong);
    return *wrong;
  }
  GivenRequest given;
  given.asked = std::get<DesignRequest>(std::move(parsed));
  const optimizer::Problem& problem = given.asked.problem;
  given.remarks = given.asked.remarks;
  given.remarks.PutUnder("/requirements");
  TellAmbient(problem.ambient);
  if (const std::optional<Reader> other = reader.OptionalObject("beside"))
    given.beside = ReadGivenDesign(*other, problem);
  given.design = ReadGivenDesign(reader.Object("design"), problem);
  reader.Finish();
  const auto complete = [&](optimizer::Design& design, const char* pointer) {
    AddOutside(problem, design);
    if (errors.empty()) CheckCombination(design, problem, parts, pointer, errors);
    if (errors.empty()) design = WithReservoirVolume(std::move(design), problem);
    if (errors.empty()) WarnOfMissingJoints(design, problem, pointer);
  };
  complete(given.design, "/design");
  if (given.beside) complete(*given.beside, "/beside");
  if (!errors.empty()) return errors;
  given.remarks.Append(recorder.Take());
  return given;
}

}  // namespace plenum::api
