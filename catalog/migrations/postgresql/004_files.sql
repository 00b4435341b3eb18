-- Files of documents, each once under the hash of its content: 0005_files.sql of SQLite. Data
-- sheets are compressed already.
CREATE TABLE file (
  sha256 text COLLATE "C" NOT NULL PRIMARY KEY CHECK (sha256 ~ '^[0-9a-f]{64}$'),
  media_type text NOT NULL CHECK (length(media_type) BETWEEN 3 AND 100),
  bytes bigint NOT NULL CHECK (bytes BETWEEN 1 AND 20971520)
);
CREATE TABLE file_piece (
  sha256 text COLLATE "C" NOT NULL REFERENCES file (sha256),
  place bigint NOT NULL CHECK (place BETWEEN 0 AND 79),
  content bytea NOT NULL CHECK (length(content) BETWEEN 1 AND 262144),
  PRIMARY KEY (sha256, place)
);
ALTER TABLE file_piece ALTER COLUMN content SET STORAGE EXTERNAL;
CREATE TRIGGER file_is_not_deleted BEFORE DELETE ON file
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a file is never deleted');
CREATE TRIGGER file_is_not_changed BEFORE UPDATE ON file
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a file is never changed');
CREATE TRIGGER file_piece_is_not_deleted BEFORE DELETE ON file_piece
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a file is never deleted');
CREATE TRIGGER file_piece_is_not_changed BEFORE UPDATE ON file_piece
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a file is never changed');
