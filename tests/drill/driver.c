/* Drives an FMU of version 2.0 on Windows: states come from standard input, its forces go to standard output. */

#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <windows.h>

typedef struct { void *logger, *allocate, *release, *finished, *environment; } callbacks;

int main(int count, char **arguments)
{
    HMODULE library = LoadLibraryA(arguments[1]);
    if (count != 4 || !library)
        return 2;
#define GET(type, name, ...) \
    type (*name)(__VA_ARGS__) = (type (*)(__VA_ARGS__))(void *)GetProcAddress(library, "fmi2" #name)
    GET(void *, Instantiate, const char *, int, const char *, const char *, const callbacks *, int, int);
    GET(int, SetupExperiment, void *, int, double, double, int, double);
    GET(int, EnterInitializationMode, void *);
    GET(int, ExitInitializationMode, void *);
    GET(int, SetReal, void *, const unsigned *, size_t, const double *);
    GET(int, GetReal, void *, const unsigned *, size_t, double *);
    GET(int, DoStep, void *, double, double, int);
    GET(int, Terminate, void *);
    GET(void, FreeInstance, void *);
    callbacks none = {0};
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
    void *fmu = Instantiate("fmu", 1, arguments[2], arguments[3], &none, 0, 0);
    if (!fmu || SetupExperiment(fmu, 0, 0, 0, 0, 0) || EnterInitializationMode(fmu) || ExitInitializationMode(fmu))
        return 3;
    const unsigned state[8] = {0, 1, 2, 3, 4, 5, 6, 7}, force[2] = {8, 9};
    double x[8], u[2];
    for (int step = 0; fread(x, sizeof x[0], 8, stdin) == 8; step++) {
        if (SetReal(fmu, state, 8, x) || DoStep(fmu, step * 0.01, 0.01, 1) || GetReal(fmu, force, 2, u))
            return 4;
        fwrite(u, sizeof u[0], 2, stdout);
    }
    Terminate(fmu);
    FreeInstance(fmu);
    return 0;
}
