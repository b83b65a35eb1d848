"""Tables of roads and drives as engineers have them: read from text, spreadsheets and loggers' files."""
