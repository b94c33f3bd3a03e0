"""Tables of the documents that follow from the code: `make docs` writes them, a test fails while one is stale.

A document holds a table between `<!-- generated: NAME -->` and `<!-- end -->`; `TABLES[NAME]` makes it. To add a table, write a
function that returns Markdown, enter it in `app.documents.tables.TABLES` and put the two comments into the document.
"""
