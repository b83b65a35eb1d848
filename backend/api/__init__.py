"""HTTP: each route reads the request, calls one service and answers."""
