// What is noticed while documents are read, beside errors: numbers that were given with a unit,
// values that look like another unit, and the remarks of whoever wrote the document.
//
//   RemarkRecorder recorder;
//   … readers read …
//   Remarks remarks = recorder.Take();     // of all that was read meanwhile on this thread
#ifndef PLENUM_API_JSON_REMARKS_H_
#define PLENUM_API_JSON_REMARKS_H_

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "api/json/json.h"

namespace plenum::api {

struct Remarks {
  Json understood = Json::array();  // { pointer, given, value, unit } and more
  Json warnings = Json::array();    // { pointer, detail }
  Json notes = Json::array();       // { pointer, note }

  // "understood", "warnings" and "notes" of an answer, each where there is any.
  void AddTo(Json& answer) const;
  // Of a document that stands inside another one.
  void PutUnder(std::string_view pointer);
  void Append(const Remarks& more);
};

// The same of errors.
void PutUnder(std::string_view pointer, Errors& errors);

class RemarkRecorder {
 public:
  RemarkRecorder();  // hears all readers of this thread, until another one does in its stead
  ~RemarkRecorder();
  RemarkRecorder(const RemarkRecorder&) = delete;
  RemarkRecorder& operator=(const RemarkRecorder&) = delete;

  // The one of this thread, or null.
  static RemarkRecorder* Current();

  // What absolute pressures are made gauge with, once the document has said it.
  void SetAmbient(double kpa_abs) { ambient_kpa_abs_ = kpa_abs; }
  std::optional<double> ambient_kpa_abs() const { return ambient_kpa_abs_; }

  // Each remark is kept once, however often its place is read.
  void Understood(const std::string& pointer, const Json& understood);
  void Warn(const std::string& pointer, const std::string& detail);
  void Note(const std::string& pointer, const Json& note);

  Remarks Take();
  // Tells the recorder that heard the readers before; `place` gives where each remark belongs.
  void TellOuter(const std::function<std::string(const std::string&)>& place);

 private:
  void Add(Json& list, const std::string& pointer, const Json& remark);

  RemarkRecorder* outer_;
  std::optional<double> ambient_kpa_abs_;
  Remarks remarks_;
  std::set<std::string> known_;
};

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_REMARKS_H_
