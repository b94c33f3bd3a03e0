"""REST endpoints of the run table."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query
from fastapi.responses import FileResponse, Response
from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.access import Role, allowed
from app.calculations.answer import CalculatedFile
from app.calculations.bound import Bound
from app.dependencies import OneSession
from app.openapi import file
from app.runs.shelves import Shelf
from app.runs.table import RunTableService, Wanted
from app.runs.table_schemas import ColumnList, RunTable

router = APIRouter(prefix="/api/v1", tags=["runs"])
TABLE = Bound("table of runs", seconds=120, megabytes=2000, mend="filter the runs or choose fewer columns", long=True)


class Chosen(BaseModel):
    """Columns, filter and order of the run table. An empty parameter is ignored."""

    model_config = ConfigDict(extra="forbid")

    columns: str = Field("", max_length=4000, description="keys of columns, separated by commas; empty: the default columns")
    where: str = Field("", max_length=4000, description="conditions, such as `mte_mm:1<0.5;tag=calibration`")
    q: str = Field("", max_length=200, description="text in name, id or tags, or the number of a run: `#12`")
    sort: str = Field("number", max_length=200)
    order: str = Field("desc", pattern="^(asc|desc)$")
    shelf: Shelf = Shelf.SHOWN

    @model_validator(mode="before")
    @classmethod
    def _given(cls, query: dict[str, Any]) -> dict[str, Any]:
        return {name: value for name, value in query.items() if value not in ("", [""])}

    def wanted(self) -> Wanted:
        columns = [key for one in self.columns.split(",") if (key := one.strip())]
        return Wanted(columns, self.where, self.q, self.sort, self.order == "desc", self.shelf)


class ChosenPage(Chosen):
    """Columns, filter, order and page of the run table."""

    limit: int = Field(100, ge=1, le=500)
    offset: int = Field(0, ge=0, le=10**9)


def table_service(session: OneSession) -> RunTableService:
    """The service of the run table in the session of the request."""
    return RunTableService(session)


Table = Annotated[RunTableService, Depends(table_service)]


@router.get("/runs/columns")
@allowed(Role.VIEWER)
def columns(table: Table) -> ColumnList:
    """Every column of the run table: facts, measures, and the plan fields that the stored plans have."""
    return table.columns()


@router.get("/runs/table")
@allowed(Role.VIEWER)
def page(chosen: Annotated[ChosenPage, Query()], table: Table) -> RunTable:
    """A page of the run table with chosen columns. `where` filters and `sort` orders by any column, plan fields too."""
    return table.page(chosen.wanted(), chosen.limit, chosen.offset)


@router.get("/runs/table.csv", response_class=FileResponse, responses=file("text/csv"))
@allowed(Role.VIEWER)
def export(chosen: Annotated[Chosen, Query()], table: Table) -> Response:
    """The run table with chosen columns as CSV: all runs that the filter keeps, at most 100 000."""
    wanted = chosen.wanted()
    table.page(wanted, 1, 0)  # a bad filter is refused before the first line
    return CalculatedFile(TABLE, "runs.csv", "text/csv", _write, table, wanted)


def _write(path: Path, table: RunTableService, wanted: Wanted) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        for row in table.export(wanted):
            writer.writerow(["; ".join(cell) if isinstance(cell, list) else cell for cell in row])
