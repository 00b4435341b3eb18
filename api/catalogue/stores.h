// The stores of the catalogue for the service and the commands, which see api/ alone.
#ifndef PLENUM_API_CATALOGUE_STORES_H_
#define PLENUM_API_CATALOGUE_STORES_H_

#include "catalog/fields/csv.h"
#include "catalog/store/backup.h"
#include "catalog/store/content_hash.h"
#include "catalog/store/copy.h"
#include "catalog/store/documents/document_files.h"
#include "catalog/store/jobs/job_store.h"
#include "catalog/store/jobs/shared_job_store.h"
#include "catalog/store/place.h"
#include "catalog/store/shared_tokens.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/store.h"
#include "catalog/store/uncertain_write.h"

#endif  // PLENUM_API_CATALOGUE_STORES_H_
