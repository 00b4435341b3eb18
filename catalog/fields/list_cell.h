// A list in one cell of a table, as JSON text: texts, or flat objects of texts and numbers.
//
//   ["V114","V100"]      [{"supplier":"Shop","price":12.5,"currency":"EUR"}]
#ifndef PLENUM_CATALOG_FIELDS_LIST_CELL_H_
#define PLENUM_CATALOG_FIELDS_LIST_CELL_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

// Members of an object by name, numbers as they are written; those that are null are left out.
using ListObject = std::map<std::string, std::string, std::less<>>;

// `error` names what is wrong and is empty where the whole text was read.
struct TextList {
  std::vector<std::string> items;
  std::string error;
};
struct ObjectList {
  std::vector<ListObject> items;
  std::string error;
};
TextList ParseTextList(std::string_view json);
ObjectList ParseObjectList(std::string_view json);

// The text between quotes, escaped: what JSON cannot hold plainly, and nothing else.
std::string QuoteJson(std::string_view text);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LIST_CELL_H_
