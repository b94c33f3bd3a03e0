"""Calculations of the web service, each in a process of its own with bounds.

A request whose processor time or memory follows from its input is not computed in the web process, where it would delay
every other request, Abort included. It is a calculation: a function of a module, with picklable arguments, within a `Bound`.

    STABILITY = Bound("stability prediction", seconds=20, megabytes=1000, mend="use fewer storeys")

An endpoint without a database returns it, and the process makes the JSON:

    @router.post("/api/v1/stability", response_model=StabilityOut, responses=told(503))
    def predict(plan: PlanData) -> Response:
        return Calculated(STABILITY, predicted, plan)

An endpoint that gathers rows first does the same: its session ends before the calculation begins. A function that makes a
file returns `Made`. A coroutine that goes on with the result awaits `of_request(request, STABILITY, predicted, plan)`; an
endpoint in a thread takes the dependency `Calculating` and calls `calculate(STABILITY, predicted, plan)`.

The errors that the function raises are raised in the web process: NotFound, Conflict and RthsError are answered as ever.
A calculation that exceeds its processor time or its memory is refused with 422 and the bound. Waiting for a place is bounded
too: clients take turns, and 503 with Retry-After answers what does not fit. A calculation ends when its client leaves.
"""
