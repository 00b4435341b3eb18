#include "api/design/sweep/sweep_request.h"

#include <algorithm>
#include <set>
#include <utility>

#include "api/design/read/requirements_reader.h"
#include "api/json/reader.h"
#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

struct Patch {
  std::string name;
  const Json* merge = nullptr;
  std::string pointer;  // to `merge`
};

// Merging takes a time like the fields of the one times those of the other.
constexpr std::size_t kFieldsOfObjectMax = 1000;
bool IsCrowded(const Json& value) {
  return (value.is_object() && value.size() > kFieldsOfObjectMax) ||
         (value.is_structured() && std::any_of(value.begin(), value.end(), IsCrowded));
}

std::vector<Patch> ReadPatches(Reader& sweep, Errors& errors) {
  std::vector<Patch> patches;
  std::set<std::string> names;
  for (const Element& element : sweep.List("patches", 1, kSweepPatchesMax)) {
    Reader reader(element, errors);
    Patch patch{reader.Text("name"), reader.Raw("merge"), reader.Pointer("merge")};
    reader.Finish();
    if (patch.merge == nullptr)
      reader.Fail("merge", "is required: what the requirements say instead, {} for nothing");
    else if (!patch.merge->is_object())
      reader.Fail("merge", "must be an object, not " + KindOf(*patch.merge));
    else if (IsCrowded(*patch.merge))
      reader.Fail("merge", "holds an object with more than " + std::to_string(kFieldsOfObjectMax) +
                               " fields");
    if (!patch.name.empty() && !names.insert(patch.name).second)
      reader.Fail("name", "is given twice: " + Quoted(patch.name));
    patches.push_back(std::move(patch));
  }
  return patches;
}

// Whether the patch itself says the value at the pointer, or takes it away.
bool Says(const Json& merge, const std::string& pointer) {
  const Json* at = &merge;
  for (std::size_t from = 1; from <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', from), pointer.size());
    const std::string step = Json::json_pointer("/" + pointer.substr(from, end - from)).back();
    from = end + 1;
    const auto found = at->find(step);
    if (found == at->end()) return false;
    if (!found->is_object()) return true;  // it replaces what it stands for, with all that is in it
    at = &*found;
  }
  return true;
}

bool IsPointer(const std::string& pointer) { return pointer.empty() || pointer.front() == '/'; }

class Merger {
 public:
  Merger(const Json& base, const std::vector<catalog::Part>& parts,
         const std::vector<catalog::ModelRevision>& models)
      : base_(base), parts_(parts), models_(models) {}

  // Nothing where there are errors.
  std::optional<SweptRequest> Merge(const Patch& patch, Errors& errors) {
    SweptRequest swept{patch.name, base_, "", {}};
    swept.requirements.merge_patch(*patch.merge);
    auto parsed = ParseRequirements(swept.requirements, parts_, models_);
    if (auto* wrong = std::get_if<Errors>(&parsed)) {
      for (Error& error : *wrong) Place(patch, std::move(error), errors);
      return std::nullopt;
    }
    auto& request = std::get<DesignRequest>(parsed);
    swept.name = std::move(request.name);
    swept.model = std::move(request.model);
    return swept;
  }

 private:
  void Place(const Patch& patch, Error error, Errors& errors) {
    if (IsPointer(error.pointer) && !error.pointer.empty() && Says(*patch.merge, error.pointer)) {
      error.pointer.insert(0, patch.pointer);
    } else if (IsErrorOfBase(error)) {
      error.pointer.insert(0, "/requirements");
      if (!told_.insert(error.pointer + " " + error.detail).second) return;
    } else {
      error.detail =
          (error.pointer.empty() ? "" : "with it, " + error.pointer + " ") + error.detail;
      error.pointer = patch.pointer;
    }
    errors.push_back(std::move(error));
  }

  bool IsErrorOfBase(const Error& error) {
    if (!of_base_) {
      auto parsed = ParseRequirements(base_, parts_, models_);
      auto* wrong = std::get_if<Errors>(&parsed);
      of_base_ = wrong != nullptr ? std::move(*wrong) : Errors();
    }
    return std::find(of_base_->begin(), of_base_->end(), error) != of_base_->end();
  }

  const Json& base_;
  const std::vector<catalog::Part>& parts_;
  const std::vector<catalog::ModelRevision>& models_;
  std::optional<Errors> of_base_;
  std::set<std::string> told_;
};

// Finds the values of two documents that differ, without their notes.
class Differences {
 public:
  void Look(const Json& one, const Json& other, const std::string& pointer) {
    if (pointers_.size() >= kSweepFieldsMax || one == other) return;
    if (one.is_object() && other.is_object()) return LookAtFields(one, other, pointer);
    if (one.is_array() && other.is_array() && one.size() == other.size()) {
      for (std::size_t i = 0; i < one.size(); ++i)
        Look(one[i], other[i], pointer + "/" + std::to_string(i));
      return;
    }
    if (std::find(pointers_.begin(), pointers_.end(), pointer) == pointers_.end())
      pointers_.push_back(pointer);
  }
  const std::vector<std::string>& pointers() const { return pointers_; }

 private:
  void LookAtFields(const Json& one, const Json& other, const std::string& pointer) {
    static const Json kNone;
    for (const Json* fields : {&other, &one})
      for (const auto& [name, value] : fields->items()) {
        const auto left = one.find(name), right = other.find(name);
        if (name == "note" || (fields == &one && right != other.end())) continue;
        Look(left == one.end() ? kNone : *left, right == other.end() ? kNone : *right,
             pointer + "/" + EscapePointer(name));
      }
  }

  std::vector<std::string> pointers_;
};

// A number, word or truth value; null where there is none or more.
Json ValueAt(const Json& document, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  if (!document.contains(place)) return nullptr;
  const Json& value = document.at(place);
  if (value.is_string()) return Clip(value.get_ref<const std::string&>(), kTextCharactersMax);
  return value.is_structured() ? Json() : value;
}

Json ObjectiveOf(const Json& requirements) {
  const auto found = requirements.find("objective");
  return found == requirements.end() || found->is_null() ? Json{{"minimize", "mass_kg"}} : *found;
}

Json PlanOf(const SweepRequest& sweep, const Json& base) {
  Differences differences;
  for (const SweptRequest& request : sweep.requests)
    differences.Look(base, request.requirements, "");
  const std::vector<std::string>& varied = differences.pointers();
  Json objective = ObjectiveOf(sweep.requests.front().requirements);
  Json patches = Json::array();
  for (const SweptRequest& request : sweep.requests) {
    Json values = Json::array();
    for (const std::string& pointer : varied)
      values.push_back(ValueAt(request.requirements, pointer));
    patches.push_back({{"name", request.patch}, {"values", std::move(values)}});
    if (ObjectiveOf(request.requirements) != objective) objective = nullptr;
  }
  return {{"name", sweep.name},
          {"objective", std::move(objective)},
          {"varied", varied},
          {"patches", std::move(patches)}};
}

std::size_t BytesOf(const std::vector<SweptRequest>& requests) {
  std::size_t bytes = 0;
  for (const SweptRequest& request : requests) bytes += request.requirements.dump().size();
  return bytes;
}

}  // namespace

Parsed<SweepRequest> ParseSweep(const Json& document, const std::vector<catalog::Part>& parts,
                                const std::vector<catalog::ModelRevision>& models) {
  Errors errors;
  const RemarkRecorder recorder;
  Reader reader(document, "", errors);
  reader.Schema("sweep/1");
  SweepRequest sweep;
  sweep.name = reader.Text("name", "");
  const Json* base = reader.Raw("requirements");
  if (base == nullptr || !base->is_object())
    reader.Fail("requirements", "is required: a document requirements/1");
  const std::vector<Patch> patches = ReadPatches(reader, errors);
  reader.Finish();
  if (!errors.empty()) return errors;

  Merger merger(*base, parts, models);
  for (const Patch& patch : patches) {
    if (errors.size() >= kErrorsCollectedMax) break;
    if (auto swept = merger.Merge(patch, errors)) sweep.requests.push_back(*std::move(swept));
  }
  if (errors.empty() && BytesOf(sweep.requests) > kSweepBytesMax)
    errors.push_back({"/patches", "the requirements with each patch come to more than " +
                                      std::to_string(kSweepBytesMax) +
                                      " bytes (sweep_bytes_max); divide the sweep"});
  if (!errors.empty()) return errors;
  if (sweep.name.empty()) sweep.name = sweep.requests.front().name;
  sweep.plan = PlanOf(sweep, *base);
  return sweep;
}

}  // namespace plenum::api
