"""Where tables are computed: in this process, or in a supervised one of its own."""
