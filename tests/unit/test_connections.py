"""Which connection is closed for a new one, and when a new one finds no room."""

from dataclasses import dataclass, field

from backend.http.connections import HEALTH_CONNECTIONS, Admission, Connections, Served


@dataclass(eq=False)
class Fake:
    """One connection, which tells when it is closed."""

    idle: bool = True
    closed: bool = field(default=False, init=False)

    def evict(self) -> None:
        self.closed = True


def several(connections: Connections, address: str, count: int, *, idle: bool = True) -> list[Fake]:
    connected = [Fake(idle=idle) for _ in range(count)]
    for each in connected:
        assert connections.add(each, address).served is Served.ALL
    return connected


def test_a_clients_longest_unused_connection_goes_for_its_next() -> None:
    connections = Connections(per_client=3, total=100)
    first, second, third = several(connections, "192.0.2.1", 3)
    first.idle = False
    connections.mark_used(second)
    several(connections, "192.0.2.1", 1)
    assert [first.closed, second.closed, third.closed] == [False, False, True]


def test_a_client_whose_connections_are_all_in_use_gets_no_more() -> None:
    connections = Connections(per_client=3, total=100)
    busy = several(connections, "2001:db8::1", 3, idle=False)
    assert connections.add(Fake(), "2001:db8::2") == Admission(Served.HEALTH, 429), (
        "the same network is the same client"
    )
    several(connections, "2001:db8:0:1::1", 1)
    for _ in range(2):  # what has ended takes no room, and ends once
        connections.remove(busy[0])
        connections.mark_used(busy[0])
    several(connections, "2001:db8::3", 1)


def test_where_all_are_taken_an_idle_one_of_the_client_with_most_goes() -> None:
    connections = Connections(per_client=10, total=10)
    greedy, modest = several(connections, "192.0.2.1", 7), several(connections, "192.0.2.2", 3)
    for each in greedy[:5]:
        each.idle = False
    several(connections, "192.0.2.3", 2)
    assert [each.closed for each in greedy] == [False] * 5 + [True] * 2
    several(connections, "192.0.2.4", 1)
    assert [each.closed for each in modest] == [True, False, False], "the greedy client has none idle any more"


def test_a_known_proxy_is_no_client_and_keeps_its_connections() -> None:
    connections = Connections(per_client=2, total=5, is_proxy=lambda address: address == "10.0.0.1")
    of_proxy = several(connections, "10.0.0.1", 4)
    (other,) = several(connections, "192.0.2.1", 1)
    several(connections, "10.0.0.1", 1)
    assert other.closed
    assert connections.add(Fake(), "192.0.2.2") == Admission(Served.HEALTH, 503)
    assert not any(each.closed for each in of_proxy)


def test_whoever_asks_for_health_finds_room_as_long_as_any_of_it_is_idle() -> None:
    connections = Connections(per_client=100, total=5)
    several(connections, "192.0.2.1", 5, idle=False)
    asking = [Fake() for _ in range(HEALTH_CONNECTIONS + 3)]
    for each in asking:
        assert connections.add(each, "192.0.2.1") == Admission(Served.HEALTH, 503)
    assert [each.closed for each in asking] == [True] * 3 + [False] * HEALTH_CONNECTIONS
    for each in asking:
        each.idle = False
    assert connections.add(Fake(), "192.0.2.2") == Admission(Served.NOTHING, 503)
