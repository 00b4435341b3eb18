// The text of a recording before it is a table: comments, columns with blanks between them.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_TEXT_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_TEXT_H_

#include <string>
#include <string_view>

namespace plenum::api {

// The text without lines that begin with #, % or //. Such lines at its top only lose the mark,
// since the headings may stand there. Lines keep their numbers.
std::string WithoutComments(std::string_view text);

// Blanks between columns as tabs. A line with a number among its words has columns at each blank;
// another line, which may be the headings, at two or more blanks if it has such, else at each
// blank. No column begins at a bracket: "Time (ms)" is one heading.
std::string WithTabs(std::string_view text);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_TEXT_H_
