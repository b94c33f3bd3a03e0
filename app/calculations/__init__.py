"""Calculations of the web service, each in a process of its own with bounds.

A request whose processor time or memory follows from its input is not computed in the web process, where it would delay
every other request, Abort included. It is a calculation: a function of a module, with picklable arguments, within a `Bound`.

    STABILITY = Bound("stability prediction", seconds=20, megabytes=1000, mend="use fewer storeys")

An endpoint without a database returns it, and the process makes the JSON:

    @router.post("/api/v1/stability", response_model=StabilityOut, responses=told(503))
    def predict(plan: PlanData) -> Response:
        return Calculated(STABILITY, predicted, plan)

An endpoint that reads rows passes its service: the process has a session of its own (app/calculations/orders.py), and that of
the request ends before the calculation begins. A function that makes a body returns `Made`; one that writes a large download
is given to `CalculatedFile`. An endpoint that goes on with the result takes the dependency `Calculating` and calls
`calculate(STABILITY, predicted, plan)`. What each route costs at most is declared in tests/app/bounds.py.

The errors that the function raises are raised in the web process: NotFound, Conflict and RthsError are answered as ever.
A calculation that exceeds its processor time or its memory is refused with 422 and the bound. Waiting for a place is bounded
too: clients take turns, and 503 with Retry-After answers what does not fit. A calculation ends when its client leaves.
"""
