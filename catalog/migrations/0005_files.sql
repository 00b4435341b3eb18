-- Files of documents: data sheets, recordings. A file is kept once, under the hash of its content,
-- whichever parts and revisions refer to it; so a part as it was before finds its files, too. The
-- content lies in pieces, so that it can be copied and sent without all of it in memory.
CREATE TABLE file (
  sha256 TEXT NOT NULL PRIMARY KEY CHECK (length(sha256) = 64 AND sha256 NOT GLOB '*[^0-9a-f]*'),
  media_type TEXT NOT NULL CHECK (length(media_type) BETWEEN 3 AND 100),
  bytes INTEGER NOT NULL CHECK (bytes BETWEEN 1 AND 20971520)
) STRICT, WITHOUT ROWID;
CREATE TABLE file_piece (
  sha256 TEXT NOT NULL REFERENCES file (sha256),
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 79),
  content BLOB NOT NULL CHECK (length(content) BETWEEN 1 AND 262144),
  PRIMARY KEY (sha256, place)
) STRICT;
CREATE TRIGGER file_is_not_deleted BEFORE DELETE ON file
  BEGIN SELECT RAISE(ABORT, 'a file is never deleted'); END;
CREATE TRIGGER file_is_not_changed BEFORE UPDATE ON file
  BEGIN SELECT RAISE(ABORT, 'a file is never changed'); END;
CREATE TRIGGER file_piece_is_not_deleted BEFORE DELETE ON file_piece
  BEGIN SELECT RAISE(ABORT, 'a file is never deleted'); END;
CREATE TRIGGER file_piece_is_not_changed BEFORE UPDATE ON file_piece
  BEGIN SELECT RAISE(ABORT, 'a file is never changed'); END;
