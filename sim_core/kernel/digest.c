/* Which sources the library is of: SHA-256 of this folder's C files, one after another by name (setup.py). */

const char *ridelab_digest(void)
{
    return RIDELAB_SOURCES;
}
