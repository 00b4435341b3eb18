-- Saved model revisions: what a diagnosis found, by name. Saving a name again adds a version; what
-- was ranked with a version can always be ranked again.
CREATE TABLE model (
  name TEXT NOT NULL CHECK (length(name) BETWEEN 1 AND 100 AND name NOT GLOB '*[^a-z0-9._-]*'
    AND name GLOB '[a-z0-9]*' AND name <> 'nominal'),
  version INTEGER NOT NULL CHECK (version BETWEEN 1 AND 9007199254740991),
  at TEXT NOT NULL CHECK (length(at) = 20),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  document TEXT NOT NULL CHECK (length(document) BETWEEN 2 AND 10000000),
  hash TEXT NOT NULL CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  PRIMARY KEY (name, version)
) STRICT;
CREATE TRIGGER model_is_not_deleted BEFORE DELETE ON model
  BEGIN SELECT RAISE(ABORT, 'a model revision is never deleted'); END;
CREATE TRIGGER model_is_not_changed BEFORE UPDATE ON model
  BEGIN SELECT RAISE(ABORT, 'a model revision is never changed'); END;
