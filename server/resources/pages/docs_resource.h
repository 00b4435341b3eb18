// The built documentation (docs/build.sh) below "/docs/".
#ifndef PLENUM_SERVER_RESOURCES_PAGES_DOCS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_PAGES_DOCS_RESOURCE_H_

#include <filesystem>

#include "server/call/reply.h"

namespace plenum::server {

// Where the documentation of this program stands: build/docs/html of the checkout in whose build
// folder the program lies, else share/plenum/docs beside the folder of the program, else below
// /usr. Only names the folder.
std::filesystem::path DocsFolder();

// The file of `folder` that the path names below "/docs/", index.html for the path of a folder.
// Asked for anew each time (304 where If-None-Match holds its tag). 404 for a path that leads out
// of the folder or begins a name with a dot, and, with how to build it, without documentation.
Reply GetDocs(const std::filesystem::path& folder, const Call& call);

// From "/docs" to "/docs/", below which the links of its pages lead.
Reply RedirectToDocs(const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_PAGES_DOCS_RESOURCE_H_
