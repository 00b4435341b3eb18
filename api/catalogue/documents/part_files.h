// The documents of a part as JSON, and what their files are called.
#ifndef PLENUM_API_CATALOGUE_DOCUMENTS_PART_FILES_H_
#define PLENUM_API_CATALOGUE_DOCUMENTS_PART_FILES_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "catalog/store/documents/document_files.h"

namespace plenum::api {

// The media type of what no other is known of.
inline constexpr char kAnyMediaType[] = "application/octet-stream";
// Media types that the file of a document may have. A page, which a browser would run, and types
// that any page may send without being asked (text/plain, forms) are not among them.
const std::vector<std::string_view>& DocumentTypes();
// The one that a name or an address ends with: ".pdf", ".csv", …; kAnyMediaType where it is none
// of these.
std::string MediaTypeOf(const std::string& link);

// The name under which the file is saved: the last word of the link, without signs that a file
// system may not take; the hash where nothing is left.
std::string FileNameOf(const catalog::Document& document);

// { "link", "sha256", "file": { "media_type", "bytes", "href" } }; "file" is null where it is not
// kept. `href` is the path in the service.
Json RenderDocument(const catalog::Store& store, const std::string& id,
                    const catalog::Document& document);
// { "id", "documents": [ … ], "catalogue_revision" } of a part as it is in `revision`.
Json RenderDocuments(const catalog::Store& store, const catalog::Part& part,
                     const catalog::Revision& revision);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_DOCUMENTS_PART_FILES_H_
