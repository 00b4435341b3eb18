#include "api/json/remarks.h"

#include <utility>

namespace plenum::api {
namespace {

thread_local RemarkRecorder* current_remarks = nullptr;

}  // namespace

void Remarks::AddTo(Json& answer) const {
  if (!understood.empty()) answer["understood"] = understood;
  if (!warnings.empty()) answer["warnings"] = warnings;
  if (!notes.empty()) answer["notes"] = notes;
}

void Remarks::PutUnder(std::string_view pointer) {
  for (Json* list : {&understood, &warnings, &notes})
    for (Json& remark : *list)
      remark["pointer"] = std::string(pointer) + remark["pointer"].get<std::string>();
}

void PutUnder(std::string_view pointer, Errors& errors) {
  for (Error& error : errors) error.pointer.insert(0, pointer);
}

void Remarks::Append(const Remarks& more) {
  understood.insert(understood.end(), more.understood.begin(), more.understood.end());
  warnings.insert(warnings.end(), more.warnings.begin(), more.warnings.end());
  notes.insert(notes.end(), more.notes.begin(), more.notes.end());
}

RemarkRecorder::RemarkRecorder() : outer_(std::exchange(current_remarks, this)) {
  if (outer_ != nullptr) ambient_kpa_abs_ = outer_->ambient_kpa_abs_;
}
RemarkRecorder::~RemarkRecorder() { current_remarks = outer_; }
RemarkRecorder* RemarkRecorder::Current() { return current_remarks; }

void RemarkRecorder::Add(Json& list, const std::string& pointer, const Json& remark) {
  Json placed = {{"pointer", pointer}};
  placed.update(remark);
  if (known_.insert(placed.dump()).second) list.push_back(std::move(placed));
}

void RemarkRecorder::Understood(const std::string& pointer, const Json& understood) {
  Add(remarks_.understood, pointer, understood);
}

void RemarkRecorder::Warn(const std::string& pointer, const std::string& detail) {
  Add(remarks_.warnings, pointer, {{"detail", detail}});
}

void RemarkRecorder::Note(const std::string& pointer, const Json& note) {
  Json remark = Json::object();
  remark["note"] = note;
  Add(remarks_.notes, pointer, remark);
}

Remarks RemarkRecorder::Take() { return std::exchange(remarks_, {}); }

void RemarkRecorder::TellOuter(const std::function<std::string(const std::string&)>& place) {
  const Remarks told = Take();
  if (outer_ == nullptr) return;
  outer_->ambient_kpa_abs_ = ambient_kpa_abs_;
  const auto tell = [&](const Json& from, Json& to) {
    for (Json remark : from) {
      const std::string pointer = place(remark["pointer"].get<std::string>());
      remark.erase("pointer");
      outer_->Add(to, pointer, remark);
    }
  };
  tell(told.understood, outer_->remarks_.understood);
  tell(told.warnings, outer_->remarks_.warnings);
  tell(told.notes, outer_->remarks_.notes);
}

}  // namespace plenum::api
