// Learns what a kind of document may hold by listening while documents of it are read: the readers
// that validate requests are thus also what describes them, and the two cannot differ.
//
//   SchemaRecorder recorder;
//   for (const Json& example : examples) ParseMeasurement(example);   // together: every branch
//   Json schema = recorder.Schema();                                  // JSON Schema 2020-12
//
// A field is required if every reading of its object required it without asking whether it is
// there; a field that was read in two ways may have either form, and two ranges of a number become
// the range that holds both.
#ifndef PLENUM_API_JSON_SCHEMA_RECORDER_H_
#define PLENUM_API_JSON_SCHEMA_RECORDER_H_

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "api/json/range.h"

namespace plenum::api {

class SchemaRecorder {
 public:
  SchemaRecorder();  // hears all readers of this thread while it lives
  ~SchemaRecorder();
  SchemaRecorder(const SchemaRecorder&) = delete;
  SchemaRecorder& operator=(const SchemaRecorder&) = delete;

  // The one of this thread, or null.
  static SchemaRecorder* Current();

  // An object at `pointer` is about to be read.
  void Object(const std::string& pointer);
  // A field of it was asked for; `form` is null where nothing is known of its values.
  void Field(const std::string& pointer, std::string_view name, const Json& form, bool required);
  // Whether the field is there was asked first: it may be missing or null, whatever is heard later.
  void MayBeMissing(const std::string& pointer, std::string_view name);
  // The whole of what may stand in a field, whatever is heard of its inside.
  void Fix(const std::string& pointer, std::string_view name, const Json& schema);

  Json Schema() const;

 private:
  struct Node {
    int visits = 0;  // as an object
    std::vector<Json> forms;
    Json fixed;
    bool may_be_missing = false;
    std::vector<std::string> order;  // of the fields, as they were first asked for
    std::map<std::string, std::unique_ptr<Node>, std::less<>> fields;
    std::unique_ptr<Node> items;
    int required_in = 0, last_required_visit = 0;  // visits of the object above
  };

  static Node& FieldOf(Node& node, std::string_view name);
  Node& At(const std::string& pointer);
  static void AddForm(Node& node, const Json& form);
  static Json Render(const Node& node);
  static Json RenderObject(const Node& node);

  Node root_;
};

// "note" of an object.
Json NoteForm();
// Forms of single values, with bounds as ranges of the reader have them.
Json NumberForm(const Range& range);
// A text of a number and a unit, for a field whose name ends in one.
Json QuantityForm(std::string_view name);
// What a number field may hold: the number, and where its name ends in a unit such a text, too.
// Whether a number may be a text with its unit, or a share one in percent.
bool TakesText(std::string_view name, const Range& range);
Json NumberOrQuantityForm(std::string_view name, const Range& range);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_SCHEMA_RECORDER_H_
