"""The web pages of the control room."""

from app.pages.endpoints import router

__all__ = ["router"]
