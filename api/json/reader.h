// Reads one JSON object field by field: type, range and default of each field are declared where it
// is read, and everything wrong is recorded as an error with its pointer.
//
// A field that cannot be read gives NaN, an empty text or list, so that reading goes on and later
// comparisons stay silent; whether the values may be used is decided by the list of errors at the
// end. Finish() reports the fields that nothing asked for.
#ifndef PLENUM_API_JSON_READER_H_
#define PLENUM_API_JSON_READER_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "api/json/range.h"

namespace plenum::api {

class Reader;

// One element of a list, with the pointer to it.
struct Element {
  const Json* value;
  std::string pointer;
};

class Reader {
 public:
  // `errors` must outlive the reader; records an error if `value` is not an object.
  Reader(const Json& value, std::string pointer, Errors& errors);
  Reader(const Element& element, Errors& errors);

  // Present and not null. Marks the field as known.
  bool Has(std::string_view name);

  // A field whose name ends in a unit also takes a text with a unit ("15 psi"); what was
  // understood, and what looks like another unit, goes to the RemarkRecorder of the thread.
  double Number(std::string_view name, Range range);                         // required
  double Number(std::string_view name, Range range, double fallback);        // may be missing
  std::optional<double> OptionalNumber(std::string_view name, Range range);  // missing or null

  // Whole numbers, also written 3.0 or 1e3; required without `fallback`. `low` after an error.
  int Integer(std::string_view name, int low, int high, std::optional<int> fallback = {});

  bool Bool(std::string_view name, bool fallback);

  // Text of 1 to 200 characters; required without `fallback`.
  std::string Text(std::string_view name, std::optional<std::string> fallback = {});
  // One of `allowed`; required without `fallback`. Empty after an error.
  std::string Choice(std::string_view name, const std::vector<std::string>& allowed,
                     std::optional<std::string> fallback = {});
  // The field "schema", required to be `schema`.
  void Schema(const std::string& schema) { Choice("schema", {schema}); }

  // A nested object. Required: an error if missing. Optional: none if missing or null.
  Reader Object(std::string_view name);
  std::optional<Reader> OptionalObject(std::string_view name);

  // Elements of a list of `least` to `most`; required unless `least` is 0.
  std::vector<Element> List(std::string_view name, std::size_t least, std::size_t most);
  // Texts of a list of `least` to `most`, none twice.
  std::vector<std::string> Texts(std::string_view name, std::size_t least, std::size_t most);
  // Numbers of a list of 1 to `most`, or a lone number as a list of one; required.
  std::vector<double> Numbers(std::string_view name, std::size_t most, Range range);

  // The field's raw value, null if missing.
  const Json* Raw(std::string_view name);
  // All fields in the order given.
  std::vector<std::string> Names() const;

  std::string Pointer(std::string_view name) const;
  const std::string& pointer() const { return pointer_; }
  Errors& errors() { return *errors_; }
  void Fail(std::string_view name, std::string detail);    // an error at the field
  void FailAt(std::string_view path, std::string detail);  // deeper: a path of plain steps
  void FailHere(std::string detail);                       // an error at the object itself
  // Whether so many errors were found that no more are collected: time to stop looking.
  bool Full() const;

  void Finish();

  // Tells a SchemaRecorder all that may stand in a field, where its values are not read by the
  // methods above.
  void Describe(std::string_view name, const Json& schema);

 private:
  Reader(std::string pointer, Errors& errors) : pointer_(std::move(pointer)), errors_(&errors) {}

  // The field, or null after recording that it is missing.
  const Json* Required(std::string_view name);
  // Tells a SchemaRecorder, if one listens, of a field. `form` is made only then.
  template <typename MakeForm>
  void Note(std::string_view name, bool required, MakeForm&& form);
  void Report(std::string pointer, std::string detail);
  // `name` is the field's where its unit may stand in a text, empty in a list.
  double ReadNumber(const Json& value, const std::string& pointer, Range range,
                    std::string_view name);

  const Json* object_ = nullptr;  // null: not an object, which has been reported
  std::string pointer_;
  Errors* errors_;
  std::vector<std::string> known_;
};

// "a text", "null", …: what a value is, for messages.
std::string KindOf(const Json& value);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_READER_H_
