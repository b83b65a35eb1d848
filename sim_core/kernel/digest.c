/* Which sources and flags the library is of (build.py). */

const char *ridelab_digest(void)
{
    return RIDELAB_DIGEST;
}
