MODULE CellLogic
    ! No target here: this file has to come out as it went in
    CONST num MAX_PARTS:=12;
    VAR num parts:=0;
    PERS pos offset_mm:=[583.66,0,-12.5];

    PROC main()
        parts:=0;
        WHILE parts < MAX_PARTS DO
            WaitDI diPartReady,1;
            TEST GInput(giSide)
            CASE 1:
                Path_Left;
            CASE 2:
                Path_Right;
            DEFAULT:
                TPWrite "unknown side; no MoveL [[1,2,3],[1,0,0,0] here";
                Stop;
            ENDTEST
            Incr parts;
        ENDWHILE
    ENDPROC
ENDMODULE
