"""Who counts as one client."""

import ipaddress

IPV6_PREFIX = 64  # bits: one customer of a provider usually has 2^64 addresses


def client_key(address: str) -> str:
    """Who counts as one client: an IPv4 address, a whole IPv6 network, or whatever else the server calls it."""
    try:
        parsed = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(parsed, ipaddress.IPv4Address):
        return str(parsed)
    if parsed.ipv4_mapped is not None:
        return str(parsed.ipv4_mapped)
    return str(ipaddress.ip_network((parsed, IPV6_PREFIX), strict=False).network_address)
