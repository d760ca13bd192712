/* A printer that writes a table: of each layer its height, its area and its contours. It shows what a back-end
 * in a shared library has to do; one that writes masks or moves a machine has the same five functions. */
#include <errno.h>
#include <lamella.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct table {
    FILE* file;
    char* path;       /* what the table is called once it is whole */
    char* unfinished; /* and until then */
    double tolerance; /* of contours, mm */
    int failed;       /* what errno said */
} table;

typedef struct row {
    double area; /* mm^2 */
    size_t contours;
} row;

static int32_t begin(void* user, const lamella_job_info* job, int32_t first, int32_t last, uint32_t flags,
                     int32_t* missing) {
    table* t = user;
    (void)missing;
    if ((flags & LAMELLA_RESUME) != 0) return LAMELLA_BAD_INPUT; /* a table is quickly made anew */
    fprintf(t->file, "# %s: layers %d to %d of %.4f mm\nlayer,z_mm,area_mm2,contours\n", job->name, (int)first,
            (int)last, job->layer_height);
    return LAMELLA_OK;
}

/* Several threads at once: nothing but the product is written to. */
static int32_t render(void* user, lamella_context* context, lamella_section* layer, lamella_product* product) {
    const table* t = user;
    lamella_contours_view view = {.struct_size = sizeof view};
    lamella_contours* contours = NULL;
    row* made = malloc(sizeof *made);
    int32_t status = made != NULL ? LAMELLA_OK : LAMELLA_OUT_OF_MEMORY;
    if (status == LAMELLA_OK)
        status = lamella_section_contours(context, layer, LAMELLA_PART, t->tolerance, &contours);
    if (status == LAMELLA_OK) status = lamella_contours_view_get(context, contours, &view);
    lamella_contours_destroy(contours);
    if (status != LAMELLA_OK) {
        free(made);
        return status;
    }
    made->area = product->area = view.area;
    made->contours = view.count;
    product->data = made;
    return LAMELLA_OK;
}

static int32_t write_row(void* user, const lamella_section_info* layer, const lamella_product* product) {
    table* t = user;
    const row* made = product->data;
    if (fprintf(t->file, "%d,%.4f,%.4f,%zu\n", (int)layer->layer, layer->z, made->area, made->contours) > 0)
        return LAMELLA_OK;
    t->failed = errno;
    return LAMELLA_FAULT;
}

static int32_t end(void* user) {
    table* t = user;
    if (fflush(t->file) == 0 && rename(t->unfinished, t->path) == 0) return LAMELLA_OK;
    t->failed = errno;
    return LAMELLA_FAULT;
}

static void drop(void* user, void* data) {
    (void)user;
    free(data);
}

static const char* error(void* user) {
    const table* t = user;
    return t->failed != 0 ? strerror(t->failed) : NULL;
}

static void free_table(table* t) {
    if (t->file != NULL) fclose(t->file);
    free(t->path);
    free(t->unfinished);
    free(t);
}

static char* joined(const char* a, const char* b) {
    char* text = malloc(strlen(a) + strlen(b) + 1);
    return text != NULL ? strcat(strcpy(text, a), b) : NULL;
}

static int exists(const char* path) {
    FILE* file = fopen(path, "rb");
    if (file != NULL) fclose(file);
    return file != NULL;
}

static int32_t open_table(const lamella_printer* printer, const char* path, uint32_t flags,
                          lamella_backend* backend, char* message, size_t size) {
    table* t = calloc(1, sizeof *t);
    if (t == NULL) return LAMELLA_OUT_OF_MEMORY;
    t->tolerance = printer->tolerance;
    t->path = joined(path, "");
    t->unfinished = joined(path, ".part");
    if ((flags & LAMELLA_FORCE) == 0 && exists(path)) {
        snprintf(message, size, "exists already; --force replaces it");
        free_table(t);
        return LAMELLA_BAD_INPUT;
    }
    if (t->path != NULL && t->unfinished != NULL) t->file = fopen(t->unfinished, "w");
    if (t->file == NULL) {
        snprintf(message, size, "%s", strerror(errno));
        free_table(t);
        return LAMELLA_FAULT;
    }
    backend->user = t;
    backend->begin = begin;
    backend->render = render;
    backend->write = write_row;
    backend->end = end;
    backend->drop = drop;
    backend->error = error;
    return LAMELLA_OK;
}

static void close_table(lamella_backend* backend) {
    free_table(backend->user);
}

LAMELLA_API int32_t lamella_plugin_entry(uint32_t abi_version, lamella_plugin* plugin);

int32_t lamella_plugin_entry(uint32_t abi_version, lamella_plugin* plugin) {
    if (abi_version != LAMELLA_ABI_VERSION) return LAMELLA_BAD_CALL;
    plugin->name = "areas";
    plugin->description = "a table of layer areas";
    plugin->ending = ".areas";
    plugin->open = open_table;
    plugin->close = close_table;
    return LAMELLA_OK;
}
