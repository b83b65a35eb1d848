/* Which sources and flags the library is of, and for which machine (build.py). */

const char ridelab_machine[] = RIDELAB_MACHINE;

const char *ridelab_digest(void)
{
    return RIDELAB_DIGEST;
}
