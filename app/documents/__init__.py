"""Tables of the documents that are generated from the code. `make docs` writes them; a test fails if a table is out of date.

In a document a table is between `<!-- generated: NAME -->` and `<!-- end -->`; `TABLES[NAME]` makes it. To add a table, write a
function that returns Markdown, enter it in `app.documents.tables.TABLES` and put the two comments into the document.
"""
