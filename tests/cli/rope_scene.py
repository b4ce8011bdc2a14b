"""A scene that several tests run: a rope of nine links that hangs from its first vertex."""

CHAIN = {
    "pliant": 1,
    "steps": 20,
    "settings": {"threads": 1},
    "bodies": [{
        "name": "rope",
        "mesh": {"shape": "chain", "links": 9, "direction": [1, 0, 0]},
        "mass": {"per_vertex": 0.1},
        "constraints": [
            {"type": "position", "name": "hook", "on": [0]},
            {"type": "edge_spring", "name": "links", "stiffness": 1000},
        ],
    }],
}
