# The report's page, as it was built, between two symbols.
    .section .rodata
    .global gnomon_report_page
    .global gnomon_report_page_end
gnomon_report_page:
    .incbin GNOMON_REPORT_PAGE
gnomon_report_page_end:
    .byte 0
    .section .note.GNU-stack, "", %progbits
