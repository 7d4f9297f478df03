MODULE LeftModule
    PROC Path_Left()
        MoveJ Home,v1000,z50,tProbe\WObj:=wLeft;
        MoveL Left_10,v200,z1,tProbe\WObj:=wLeft;
        MoveL Left_20,v200,z1,tProbe\WObj:=wLeft;
        MoveL Left_30,v200,z1,tProbe\WObj:=wLeft;
        MoveL Left_40,v200,fine,tProbe\WObj:=wLeft;
        MoveL Left_10,v200,fine,tProbe\WObj:=wLeft;
    ENDPROC
ENDMODULE
