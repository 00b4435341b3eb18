-- Every committed write is a revision, which stays as it is. A revision names its writer and carries
-- a hash of all parts as they were after it. `change` keeps each part as it was before the revision;
-- as it was after is the next change of that part or, without one, the part itself. So any revision
-- can be rebuilt, and the newest parts are stored once.
ALTER TABLE revision RENAME TO counter;

CREATE TABLE revision (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 0 AND 9007199254740991),
  -- NULL only while this migration runs: SQL cannot compute it.
  hash TEXT CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  at TEXT NOT NULL CHECK (length(at) = 20),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  what TEXT NOT NULL CHECK (length(what) BETWEEN 1 AND 300)
) STRICT;
INSERT INTO revision
  SELECT number, NULL, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), '', 'history begins' FROM counter;
DROP TABLE counter;

CREATE TABLE change (
  revision INTEGER NOT NULL REFERENCES revision (number),
  part_id TEXT NOT NULL CHECK (length(part_id) BETWEEN 1 AND 100),
  before TEXT CHECK (length(before) BETWEEN 1 AND 1000000),  -- NULL: the part did not exist
  PRIMARY KEY (revision, part_id)
) STRICT;
CREATE INDEX change_by_part ON change (part_id, revision);

CREATE TRIGGER revision_is_not_deleted BEFORE DELETE ON revision
  BEGIN SELECT RAISE(ABORT, 'a revision is never deleted'); END;
CREATE TRIGGER revision_is_not_changed BEFORE UPDATE ON revision WHEN OLD.hash IS NOT NULL
  BEGIN SELECT RAISE(ABORT, 'a revision is never changed'); END;
CREATE TRIGGER change_is_not_deleted BEFORE DELETE ON change
  BEGIN SELECT RAISE(ABORT, 'history is never deleted'); END;
CREATE TRIGGER change_is_not_changed BEFORE UPDATE ON change
  BEGIN SELECT RAISE(ABORT, 'history is never changed'); END;

-- Requests that must act once however often they are sent: the key a client chose, a hash of the
-- request, and the revisions before and after it.
CREATE TABLE request_key (
  key TEXT NOT NULL PRIMARY KEY CHECK (length(key) BETWEEN 1 AND 255),
  request TEXT NOT NULL CHECK (length(request) BETWEEN 1 AND 100),
  base INTEGER NOT NULL REFERENCES revision (number),
  revision INTEGER NOT NULL REFERENCES revision (number),
  at TEXT NOT NULL CHECK (length(at) = 20)
) STRICT, WITHOUT ROWID;
CREATE INDEX request_key_by_age ON request_key (at);
